#include "fem/solvers/step_control.h"

#include <algorithm>
#include <sstream>

namespace fem
{
  namespace
  {
    constexpr double relaxed_part = 0.25;    // of the first step: how far a step that is relaxed goes
    constexpr double blind_part   = 1. / 16; // of the first step: one so short that it ends where it ends

    /// Iterations up to which the equilibrium at the end of a step is believed: of short steps all.
    unsigned int trusted_iterations(const StepControl &steps, const double length)
    {
      const double shortest = steps.first * (steps.relax ? 2 * relaxed_part : blind_part);
      return length < shortest || length < 2 * steps.smallest ? StaticSolver<2>::any_number : steps.easy;
    }

    /// One accepted step of at most `length`, which becomes what the next one should try. Returns the length done.
    /// `let_go` attempts the same when the step has been cut too often; what it does may be as hard as it likes.
    template <typename Attempt, typename LetGo>
    double step(const StepControl &steps,
                double            &length,
                const double       bound,
                StepReport        &report,
                const double       time,
                const Attempt     &attempt,
                const LetGo       &let_go)
    {
      double now = std::min(length, bound);
      for (;;)
        {
          report = attempt(now);
          if (report.converged)
            break;
          now /= 2;
          const double floor   = std::min(steps.first * relaxed_part, bound);
          const bool   relaxes = steps.relax && now < floor;
          if (relaxes)
            {
              now    = floor;
              report = let_go(now);
            }
          if (report.converged)
            break;
          if (relaxes || now < steps.smallest)
            {
              std::ostringstream text;
              text << "no equilibrium beyond time " << time << ": the step was cut "
                   << (relaxes ? "and relaxed in vain. " : "below its smallest length ");
              if (!relaxes)
                text << steps.smallest << ". ";
              text << report.reason;
              throw NoEquilibrium(text.str());
            }
        }
      if (report.relaxed > 0)
        length = now * steps.growth; // what was in the way has let go
      else if (now < std::min(length, bound))
        length = now; // it was cut: go on like this
      else if (report.iterations <= steps.easy)
        length = std::min(std::max(length, now) * steps.growth, steps.largest);
      return now;
    }
  }

  template <int dim>
  void run_to(
    StaticSolver<dim> &solver, const double end, const StepControl &steps, double &length, const StepObserver &observe)
  {
    StepReport report;
    while (solver.time() < end)
      {
        const double from = solver.time();
        const double left = end - from;
        const auto   to   = [&](const double now) { return now >= left ? end : from + now; };
        const double done = step(
          steps, length, left, report, from,
          [&](const double now) { return solver.advance_to(to(now), trusted_iterations(steps, now)); },
          [&](const double now) { return solver.relax_to(to(now)); });
        if (!observe(report, done))
          return;
      }
  }

  template <int dim>
  void run_along(StaticSolver<dim>  &solver,
                 const PathControl  &control,
                 const StepControl  &steps,
                 double             &length,
                 const StepObserver &observe)
  {
    StepReport report;
    for (;;)
      {
        const auto   along = [&](const double now) { return solver.advance_along(control, now); };
        const double done  = step(steps, length, 1e300, report, solver.time(), along, along);
        if (!observe(report, done))
          return;
      }
  }

  template <int dim>
  void run_to(StaticSolver<dim> &solver, const double end, const StepControl &steps, const StepObserver &observe)
  {
    double length = steps.first;
    run_to(solver, end, steps, length, observe);
  }

  template <int dim>
  void run_along(StaticSolver<dim>  &solver,
                 const PathControl  &control,
                 const StepControl  &steps,
                 const StepObserver &observe)
  {
    double length = steps.first;
    run_along(solver, control, steps, length, observe);
  }

  template void run_to(StaticSolver<2> &, double, const StepControl &, double &, const StepObserver &);
  template void run_to(StaticSolver<3> &, double, const StepControl &, double &, const StepObserver &);
  template void run_along(StaticSolver<2> &, const PathControl &, const StepControl &, double &, const StepObserver &);
  template void run_along(StaticSolver<3> &, const PathControl &, const StepControl &, double &, const StepObserver &);
  template void run_to(StaticSolver<2> &, double, const StepControl &, const StepObserver &);
  template void run_to(StaticSolver<3> &, double, const StepControl &, const StepObserver &);
  template void run_along(StaticSolver<2> &, const PathControl &, const StepControl &, const StepObserver &);
  template void run_along(StaticSolver<3> &, const PathControl &, const StepControl &, const StepObserver &);
}
