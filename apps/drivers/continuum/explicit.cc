#include "apps/drivers/continuum/analysis.h"
#include "apps/drivers/continuum/motion.h"
#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double longest_stretch = 0.5; ///< between two chances to interrupt [s]

    template <int dim>
    class ExplicitAnalysis : public ContinuumAnalysis<dim>
    {
    public:
      ExplicitAnalysis(fem::Solid<dim> &solid_, const ContinuumModel &model)
        : solid(solid_)
        , motion(model.motion)
        , own_solver(make_motion(solid_, model))
        , solver(*own_solver)
        , steps_in_all(count_steps())
        , step(motion.end_time / static_cast<double>(steps_in_all))
        , steps_per_sample(std::max<std::int64_t>(1, steps_in_all / model.output.samples))
      {
      }

      bool finished() const override { return steps >= steps_in_all; }

      bool advance() override
      {
        const auto start = std::chrono::steady_clock::now();
        const auto spent = [&] {
          return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        };
        // Ranks must stop at the same step, and their clocks differ: on several of them a sample is done in one go.
        const bool         pauses = rank_count() == 1;
        const std::int64_t sample = std::min((steps / steps_per_sample + 1) * steps_per_sample, steps_in_all);
        do
          solver.advance(step);
        while (++steps < sample && !(pauses && spent() > longest_stretch));
        seconds += spent();
        return steps == sample;
      }

      SolidState state() const override
      {
        return {&solver.displacement(), &solver.internal_force(), &solver.external_force()};
      }

      ContinuumEnergy energy() const override
      {
        const fem::ExplicitEnergy &e = solver.energy();
        ContinuumEnergy            energy;
        energy.external = e.external;
        energy.internal = e.internal;
        energy.kinetic  = e.kinetic;
        energy.damped   = e.damped;
        energy.start    = e.start;
        return energy;
      }

      double coordinate() const override { return step * static_cast<double>(steps); }
      double end() const override { return motion.end_time; }

      std::vector<postprocess::SeriesColumn> columns() const override
      {
        return {{"time", "s"}, {"energy_kinetic", "J"}, {"energy_damped", "J"}, {"energy_start", "J"}};
      }

      std::vector<double> values() const override
      {
        const fem::ExplicitEnergy &e = solver.energy();
        return {coordinate(), e.kinetic, e.damped, e.start};
      }

      std::string details() const override
      {
        return fmt::format("time {:.3e} s, {:.0f} steps/s", coordinate(),
                           static_cast<double>(steps) / std::max(seconds, 1e-9));
      }

      std::map<std::string, double> cost() const override
      {
        return {{"steps", static_cast<double>(steps)},
                {"time_step", step},
                {"critical_step", solver.critical_step()},
                {"stepping_seconds", seconds}};
      }

      std::string linear_solver() const override { return ""; }

      void visit_state(dem::StateVisitor &visitor) override
      {
        visit_motion(visitor, solver, solid);
        visitor.scalar("steps", steps);
        visitor.scalar("stepping_seconds", seconds);
      }

    private:
      std::int64_t count_steps() const
      {
        constexpr double most = 1e12;
        const double     n    = std::ceil(motion.end_time / solver.step() * (1 - 1e-12));
        if (!(n < most))
          throw dem::InputError(fmt::format("Motion/End time = {}: would take {:.1e} steps of {:.1e} s. Check density, "
                                            "moduli and sizes: all in SI units.",
                                            motion.end_time, n, solver.step()));
        return std::max<std::int64_t>(1, static_cast<std::int64_t>(n));
      }

      fem::Solid<dim>                          &solid;
      const MotionSection                      &motion;
      std::unique_ptr<fem::ExplicitSolver<dim>> own_solver;
      fem::ExplicitSolver<dim>                 &solver;
      std::int64_t                              steps_in_all;
      double                                    step;
      std::int64_t                              steps_per_sample;
      std::int64_t                              steps   = 0;
      double                                    seconds = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_explicit_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    return std::make_unique<ExplicitAnalysis<dim>>(solid, model);
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_explicit_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_explicit_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps
