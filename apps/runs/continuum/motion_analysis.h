#pragma once

#include "apps/forecasts/duration.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/motion.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  /** A solid in explicit motion: what does not depend on the length of steps. */
  template <int dim>
  class MotionAnalysis : public ContinuumAnalysis<dim>
  {
  public:
    MotionAnalysis(fem::Solid<dim> &solid_, const ContinuumModel &model)
      : solid(solid_)
      , motion(model.motion)
      , own_solver(make_motion(solid_, model))
      , solver(*own_solver)
    {
    }

    SolidState state() const override
    {
      return {&solver.displacement(), &solver.internal_force(), &solver.external_force()};
    }

    ContinuumEnergy energy() const override { return energy_of(solver.energy()); }

    double end() const override { return motion.end_time; }

    std::vector<postprocess::SeriesColumn> columns() const override
    {
      return {{"time", "s"}, {"energy_kinetic", "J"}, {"energy_damped", "J"}, {"energy_start", "J"}};
    }

    std::vector<double> values() const override
    {
      const fem::ExplicitEnergy &e = solver.energy();
      return {this->coordinate(), e.kinetic, e.damped, e.start};
    }

    std::string details() const override
    {
      return fmt::format("time {:.3e} s, {:.0f} steps/s", this->coordinate(),
                         static_cast<double>(steps) / std::max(seconds, 1e-9));
    }

    std::map<std::string, double> cost() const override
    {
      return {{"steps", static_cast<double>(steps)},
              {"time_step", step()},
              {"critical_step", solver.critical_step()},
              {"stepping_seconds", seconds}};
    }

    std::string linear_solver() const override { return ""; }

    void visit_state(base::StateVisitor &visitor) override
    {
      visit_motion(visitor, solver, solid);
      visitor.scalar("steps", steps);
      visitor.scalar("stepping_seconds", seconds);
    }

  protected:
    virtual double step() const = 0; ///< the longest one now [s]

    /** Call `take` for steps until it says that there are enough, or it is time for a chance to interrupt. @return whether enough */
    template <typename Take>
    bool take_steps(const Take &take)
    {
      constexpr double      longest_stretch = 0.5; // between two chances to interrupt [s]
      const base::Stopwatch watch;
      // Ranks must stop at the same step, and their clocks differ: on several of them a sample is done in one go.
      const bool pauses = rank_count() == 1;
      bool       enough = false;
      do
        {
          enough = take();
          ++steps;
        }
      while (!enough && !(pauses && watch.seconds() > longest_stretch));
      seconds += watch.seconds();
      return enough;
    }

    fem::Solid<dim>                          &solid;
    const MotionSection                      &motion;
    std::unique_ptr<fem::ExplicitSolver<dim>> own_solver;
    fem::ExplicitSolver<dim>                 &solver;
    std::int64_t                              steps   = 0;
    double                                    seconds = 0;
  };

  /** Steps of one length. */
  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_explicit_analysis(fem::Solid<dim> &solid, const ContinuumModel &model);

  /** Steps by the time windows of preCICE. */
  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_precice_analysis(fem::Solid<dim> &solid, const ContinuumModel &model);

  /** Steps by what touches: of a solid whose bodies are in contact with each other. */
  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_contact_analysis(fem::Solid<dim> &solid, const ContinuumModel &model);
} // namespace apps
