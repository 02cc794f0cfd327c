#include "apps/drivers/continuum.h"

#include "apps/drivers/continuum_run.h"
#include "apps/drivers/continuum_solid.h"
#include "apps/mpi_session.h"
#include "apps/progress.h"

#include <fmt/format.h>

#include <chrono>

namespace apps
{
  namespace
  {
    /** Seconds of the first new state: a step, or a sample of an explicit motion. */
    template <int dim>
    double first_state_cost(const ContinuumModel &model)
    {
      const auto solid = make_solid<dim>(model);
      const auto analysis =
        model.is_static() ? make_static_analysis<dim>(*solid, model) : make_explicit_analysis<dim>(*solid, model);
      const auto start = std::chrono::steady_clock::now();
      analysis->run([] { return false; });
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    template <int dim>
    std::string forecast_of(const ContinuumModel &model)
    {
      const ContinuumRun<dim> run(RunRequest{}, model); // refuses what a run would refuse
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
          text += fmt::format("  duration     roughly {}, on this machine as it is now\n",
                              duration_text(states * first_state_cost<dim>(model)));
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
