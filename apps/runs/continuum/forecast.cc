#include "apps/runs/continuum/forecast.h"

#include "apps/forecasts/duration.h"
#include "apps/forecasts/run_forecast.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/cells.h"
#include "apps/runs/continuum/expected_duration.h"
#include "apps/runs/continuum/run.h"
#include "apps/runs/continuum/solid.h"
#include "apps/specimens/packing_extents.h"
#include "fem/mesh/extent.h"

#include <fmt/format.h>

#include <algorithm>

namespace apps
{
  namespace
  {
    template <int dim>
    std::string extent_line_of(const fem::Mesh<dim> &mesh)
    {
      const fem::Extent<dim> extent = fem::extent_of(mesh);
      Eigen::Vector3d        low = Eigen::Vector3d::Zero(), high = low;
      for (int d = 0; d < dim; ++d)
        {
          low[d]  = extent.low[static_cast<unsigned int>(d)];
          high[d] = extent.high[static_cast<unsigned int>(d)];
        }
      return extent_line(low, high, dim);
    }

    template <int dim>
    std::string forecast_of(const ContinuumModel &model)
    {
      const base::Stopwatch set_up;
      ContinuumRun<dim>     run(RunRequest{}, model); // refuses what a run would refuse
      const double          set_up_seconds = set_up.seconds();
      std::string           text;
      for (const std::string &warning : coarse_elements(run.body(), model))
        text += fmt::format("  warning      {}\n", warning);
      text += fmt::format("  elements     {}\n", run.body().mesh().triangulation->n_global_active_cells());
      text += fmt::format("  unknowns     {}\n", run.body().dofs().n_dofs());
      text += extent_line_of(run.body().mesh());
      const auto &groups = model.materials.groups;
      for (const auto &group : groups)
        if (const CellsConstants *cells = group->cells())
          text += fmt::format("  {:<12} {}\n", group->group, cells->forecast());
      const std::string solver = run.computation().linear_solver();
      double            states;
      if (model.is_static())
        {
          states = states_of(run.body(), model);
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
      if (model.precice.given()) // nobody is there to be rehearsed with
        return text + model.precice.forecast(run.body().boundary_dofs(model.precice.vertices, 0).size());
      try
        {
          const ExpectedRun found    = expected(run, model, states);
          const double      whole    = set_up_seconds + found.seconds;
          const bool        may_stop = model.is_static() && model.control.stop_fraction > 0 && !found.whole;
          if (!found.failure.empty())
            text +=
              fmt::format("  warning      after {:.0f} steps the next one fails: {}\n", found.states, found.failure);
          // Nothing says beforehand how many cells will break, and when: what was tried is mostly elastic.
          const bool may_break = !found.whole && std::any_of(groups.begin(), groups.end(), [](const auto &group) {
            return group->cells() != nullptr;
          });
          text += may_break ? fmt::format("  duration     at least {}, on this machine as it is now; cells whose links "
                                          "break take longer\n",
                                          duration_text(whole)) :
                              stoppable_duration_line(whole, may_stop ? 0 : whole);
        }
      catch (const std::runtime_error &failure)
        {
          text += fmt::format("  warning      the first step fails: {}\n", failure.what());
        }
      return text;
    }
  } // namespace

  std::string forecast(const ContinuumModel &model)
  {
    start_mpi();
    return model.solid.dimension == 2 ? forecast_of<2>(model) : forecast_of<3>(model);
  }

} // namespace apps
