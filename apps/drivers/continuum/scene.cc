#include "apps/drivers/continuum/scene.h"

#include "apps/drivers/continuum/run.h"
#include "apps/drivers/continuum/solid.h"
#include "apps/drivers/parts/duration.h"
#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    /** Whether every step of a static analysis solves the same linear system. */
    bool is_linear(const ContinuumModel &model)
    {
      const auto &groups = model.materials.groups;
      return !model.solid.large_displacement && std::none_of(groups.begin(), groups.end(), [](const auto &group) {
        return group->law == MaterialOfGroup::Law::concrete;
      });
    }

    /**
     * Seconds that so many new states take: steps, or samples of an explicit motion. The first ones are computed. Steps of a
     * material that is not damaged yet need few iterations; later ones are taken to need as many as cracking usually does.
     */
    template <int dim>
    double seconds_of_states(const ContinuumModel &model, const double states)
    {
      constexpr double enough = 1, measured_at_most = 10, iterations_when_cracking = 5;
      const auto       solid = make_solid<dim>(model);
      const auto       analysis =
        model.is_static() ? make_static_analysis<dim>(*solid, model) : make_explicit_analysis<dim>(*solid, model);
      const Stopwatch all;
      double          first = 0, measured = 0;
      while (!analysis->finished() && measured < std::min(states, measured_at_most) &&
             (measured < 2 || all.seconds() < enough))
        {
          while (!analysis->advance())
            continue;
          first = measured == 0 ? all.seconds() : first;
          ++measured;
        }
      const double each  = measured > 1 ? (all.seconds() - first) / (measured - 1) : first;
      const auto   costs = analysis->cost();
      const auto   found = costs.find("newton_iterations");
      if (found == costs.end() || is_linear(model))
        return first + (states - 1) * each;
      const double iteration = all.seconds() / std::max(1.0, found->second);
      return first + (states - 1) * std::max(each, iterations_when_cracking * iteration);
    }

    template <int dim>
    std::string forecast_of(const ContinuumModel &model)
    {
      const Stopwatch         set_up;
      const ContinuumRun<dim> run(RunRequest{}, model); // refuses what a run would refuse
      const double            set_up_seconds = set_up.seconds();
      std::string             text;
      text += fmt::format("  elements     {}\n", run.body().mesh().triangulation->n_global_active_cells());
      text += fmt::format("  unknowns     {}\n", run.body().dofs().n_dofs());
      const std::string solver = run.computation().linear_solver();
      double            states;
      if (model.is_static())
        {
          states = std::ceil(model.control.end / model.control.largest());
          text +=
            fmt::format("  solver       {}\n  steps        {:.0f}, and more where they are cut\n", solver, states);
        }
      else
        {
          const auto   cost  = run.computation().cost();
          const double steps = model.motion.end_time / cost.at("time_step");
          states             = std::min(steps, static_cast<double>(model.output.samples));
          text += fmt::format("  time step    {:.4g} s, critical {:.4g} s\n  steps        {:.0f}\n",
                              cost.at("time_step"), cost.at("critical_step"), steps);
        }
      try
        {
          text += duration_line(set_up_seconds + seconds_of_states<dim>(model, states));
        }
      catch (const std::runtime_error &failure)
        {
          text += fmt::format("  warning      the first step fails: {}\n", failure.what());
        }
      return text;
    }
  } // namespace

  std::string ContinuumScene::forecast() const
  {
    start_mpi();
    return model.solid.dimension == 2 ? forecast_of<2>(model) : forecast_of<3>(model);
  }

  int ContinuumScene::run(const RunRequest &request) const
  {
    start_mpi();
    return model.solid.dimension == 2 ? ContinuumRun<2>(request, model).execute() :
                                        ContinuumRun<3>(request, model).execute();
  }
} // namespace apps
