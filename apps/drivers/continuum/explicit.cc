#include "apps/drivers/continuum/analysis.h"
#include "apps/drivers/continuum/solid.h"
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

    fem::ExplicitOptions explicit_options(const ContinuumModel &model)
    {
      fem::ExplicitOptions options;
      for (const auto &group : model.materials.groups)
        options.density[group->group] = group->density;
      options.damping = model.motion.damping;
      options.safety  = model.motion.safety;
      return options;
    }

    template <int dim>
    class ExplicitAnalysis : public ContinuumAnalysis<dim>
    {
    public:
      ExplicitAnalysis(fem::Solid<dim> &solid_, const ContinuumModel &model)
        : solid(solid_)
        , motion(model.motion)
        , solver(solid_, explicit_options(model))
        , steps_in_all(count_steps())
        , step(motion.end_time / static_cast<double>(steps_in_all))
        , steps_per_sample(std::max<std::int64_t>(1, steps_in_all / model.output.samples))
      {
        const auto &v = motion.initial_velocity;
        if (v[0].given() || v[1].given() || v[2].given())
          solver.set_velocity([&v](const dealii::Point<dim> &x, const double) {
            dealii::Tensor<1, dim> at;
            for (unsigned int c = 0; c < dim; ++c)
              if (v[c].given())
                at[c] = v[c](x[0], x[1], dim == 3 ? x[dim - 1] : 0.0, 0.0);
            return at;
          });
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
        fem::ExplicitState saved   = solver.state();
        std::int64_t       started = saved.started ? 1 : 0;
        visitor.scalar("time", saved.time);
        visitor.scalar("started", started);
        saved.started = started == 1;
        visitor.scalar("energy_kinetic", saved.energy.kinetic);
        visitor.scalar("energy_internal", saved.energy.internal);
        visitor.scalar("energy_external", saved.energy.external);
        visitor.scalar("energy_damped", saved.energy.damped);
        visitor.scalar("energy_start", saved.energy.start);
        visit_vector(visitor, "displacement", saved.displacement);
        visit_vector(visitor, "velocity", saved.velocity);
        visit_vector(visitor, "internal_force", saved.internal_force);
        visit_vector(visitor, "mean_velocity", saved.mean_velocity);
        visit_vector(visitor, "last_motion", saved.last_motion);
        visitor.scalar("last_length", saved.last_length);
        solver.restore(saved);
        visitor.scalar("steps", steps);
        visitor.scalar("stepping_seconds", seconds);
        visit_histories(visitor, solid);
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

      fem::Solid<dim>         &solid;
      const MotionSection     &motion;
      fem::ExplicitSolver<dim> solver;
      std::int64_t             steps_in_all;
      double                   step;
      std::int64_t             steps_per_sample;
      std::int64_t             steps   = 0;
      double                   seconds = 0;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_explicit_analysis(fem::Solid<dim> &solid, const ContinuumModel &model)
  {
    try
      {
        return std::make_unique<ExplicitAnalysis<dim>>(solid, model);
      }
    catch (const std::invalid_argument &refusal)
      {
        throw dem::InputError(refusal.what());
      }
  }

  template std::unique_ptr<ContinuumAnalysis<2>> make_explicit_analysis(fem::Solid<2> &, const ContinuumModel &);
  template std::unique_ptr<ContinuumAnalysis<3>> make_explicit_analysis(fem::Solid<3> &, const ContinuumModel &);
} // namespace apps
