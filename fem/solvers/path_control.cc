// Static steps whose load parameter is an unknown: indirect displacement control and arc length.
#include "base/errors.h"
#include "base/number_text.h"
#include "fem/solvers/static_solver.h"

#include <deal.II/base/mpi.h>

#include <cmath>

namespace fem
{
  using namespace dealii;

  namespace
  {
    /// Difference at() - from of what a member of the solid writes at two times.
    template <typename Write>
    Vector change(const Vector &layout, const Write &write, const double from, const double to)
    {
      Vector a = layout, b = layout;
      write(from, a);
      write(to, b);
      b -= a;
      return b;
    }
  }

  template <int dim>
  void StaticSolver<dim>::prepare_path()
  {
    if (path_known)
      return;
    const Vector layout  = solid.make_vector();
    const auto   load    = [this](const double t, Vector &v) { solid.external_force(t, v); };
    const auto   support = [this](const double t, Vector &v) { solid.prescribed(t, v); };
    load_0 = support_0 = layout;
    load(0, load_0);
    support(0, support_0);
    load_1    = change(layout, load, 0, 1);
    support_1 = change(layout, support, 0, 1);
    for (const auto &[first, second] :
         {std::make_pair(load_1, change(layout, load, 1, 2)), std::make_pair(support_1, change(layout, support, 1, 2))})
      {
        Vector bend = second;
        bend -= first;
        if (bend.linfty_norm() > 1e-10 * first.linfty_norm())
          throw base::InputError(
            "path control: loads and prescribed displacements must be linear in time, which becomes the load factor.");
      }
    if (load_1.linfty_norm() == 0 && support_1.linfty_norm() == 0)
      throw base::InputError("path control: nothing grows with time, so there is no load factor to find.");
    load_1.update_ghost_values();
    support_1.update_ghost_values();
    path_known = true;
  }

  template <int dim>
  StepReport StaticSolver<dim>::advance_along(const PathControl &control, const double increment)
  {
    prepare_path();
    Trial trial{u, f_int, f_ext, current_time};
    trial.u.update_ghost_values(); // a copy has only what this rank owns
    StepReport report;
    try
      {
        report = path_newton(trial, control, increment);
      }
    catch (const MaterialFailure &failure)
      {
        report.reason = failure.what();
      }
    return finish_or_fail(report, trial);
  }

  template <int dim>
  double StaticSolver<dim>::path_correction(const PathControl &control,
                                            const double       increment,
                                            const Vector      &done,
                                            const Vector      &to_balance,
                                            const Vector      &by_load,
                                            const bool         first) const
  {
    if (control.kind == PathControl::Kind::indirect)
      {
        const double rate = measure(control, by_load);
        if (rate == 0)
          throw MaterialFailure("path control: the load does not move the controlled displacement.");
        return (increment - measure(control, done) - measure(control, to_balance)) / rate;
      }
    Vector base = done;
    base += to_balance;
    const double a = by_load * by_load, b = 2 * (base * by_load), c = base * base - increment * increment;
    const double disc = b * b - 4 * a * c;
    if (!(disc >= 0) || a == 0)
      throw MaterialFailure("arc length: the arc does not meet the path. Shorten the increment.");
    const double plus = (-b + std::sqrt(disc)) / (2 * a), minus = (-b - std::sqrt(disc)) / (2 * a);
    // Go on in the direction of the step so far; a new step goes on in the direction of the last one.
    const Vector &along = first ? last_step : done;
    if (first && along.l2_norm() == 0)
      return plus;
    const auto turn = [&](const double root) { return along * base + root * (along * by_load); };
    return turn(plus) >= turn(minus) ? plus : minus;
  }

  template <int dim>
  StepReport StaticSolver<dim>::path_newton(Trial &trial, const PathControl &control, const double increment)
  {
    StepReport report;
    solid.begin_step();
    double scale   = 0;
    Vector carried = solid.make_vector(), r = solid.make_vector(), by_load = solid.make_vector(),
           to_balance = solid.make_vector(), done = solid.make_vector();
    for (unsigned int iteration = 0; iteration <= options.iterations; ++iteration)
      {
        trial.f_ext = load_0;
        trial.f_ext.add(trial.time, load_1);
        linearise(trial, &support_1, &carried);
        unbalance(trial, r);
        report.iterations = iteration;
        report.converged  = balanced(trial, r, scale, report) && iteration > 0;
        if (report.converged)
          return report;
        if (iteration == options.iterations)
          break;

        set_tangent();
        linear->solve(to_balance, r);
        solid.constraints().set_zero(to_balance);
        Vector load = load_1;
        load -= carried;
        solid.constraints().set_zero(load);
        linear->solve(by_load, load);
        solid.constraints().set_zero(by_load);
        by_load += support_1;

        by_load.update_ghost_values();
        to_balance.update_ghost_values();
        done.update_ghost_values();
        const double more = path_correction(control, increment, done, to_balance, by_load, iteration == 0);
        done.add(1.0, to_balance, more, by_load);
        trial.time += more;
        trial.u = u;
        trial.u += done;
        trial.u.update_ghost_values();
      }
    report.reason = "no equilibrium after " + std::to_string(options.iterations) + " iterations (unbalanced " +
                    base::number_text(report.residual) + ").";
    return report;
  }

  template void       StaticSolver<2>::prepare_path();
  template void       StaticSolver<3>::prepare_path();
  template StepReport StaticSolver<2>::advance_along(const PathControl &, double);
  template StepReport StaticSolver<3>::advance_along(const PathControl &, double);
}
