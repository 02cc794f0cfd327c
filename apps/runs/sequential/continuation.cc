#include "apps/runs/sequential/continuation.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/run.h"
#include "apps/runs/continuum/snapshot.h"
#include "apps/runs/continuum/solid.h"
#include "coupling/sequential/transfer.h"
#include "postprocess/files/errors.h"

namespace apps
{
  namespace
  {
    template <int dim>
    TransferredState initialise(const ContinuumModel            &model,
                                const coupling::ParticleField   &field,
                                const coupling::TransferOptions &options,
                                const std::filesystem::path     &folder)
    {
      TransferredState                       done;
      const std::unique_ptr<fem::Solid<dim>> solid = make_solid<dim>(model);
      done.report                                  = coupling::transfer(field, options, *solid);
      const auto analysis                          = make_static_analysis(*solid, model);
      auto      &solver                            = *analysis->static_solver();
      done.settled                                 = coupling::equilibrate(*solid, solver, options.limits);
      fem::Vector reaction                         = solver.internal_force();
      reaction -= solver.external_force();
      reaction.update_ghost_values();
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      if (error)
        throw postprocess::OutputError(folder.string() + ": the folder cannot be made: " + error.message() + ".");
      done.mesh_file =
        (folder / write_solid(*solid, solver.displacement(), reaction, {folder, "solid", 0, 0})).string();
      return done;
    }

    template <int dim>
    RunResult run(const RunRequest                &request,
                  const ContinuumModel            &model,
                  const coupling::ParticleField   &field,
                  const coupling::TransferOptions &options,
                  const double                     least_force,
                  const TransferObserver          &observe)
    {
      TransferredState done;
      const auto prepare = [&](fem::Solid<dim> &solid) { done.report = coupling::transfer(field, options, solid); };
      const auto settle  = [&](fem::Solid<dim> &solid, ContinuumAnalysis<dim> &analysis) {
        try
          {
            done.settled = coupling::equilibrate(solid, *analysis.static_solver(), options.limits);
          }
        catch (const base::NumericalError &)
          {
            observe(done);
            throw;
          }
        observe(done);
      };
      ContinuumRun<dim> whole(request, model, prepare, settle);
      whole.end_where_little_is_left(least_force);
      return whole.execute();
    }
  } // namespace

  TransferredState initialise_only(const ContinuumModel            &model,
                                   const coupling::ParticleField   &field,
                                   const coupling::TransferOptions &options,
                                   const std::filesystem::path     &mesh_folder)
  {
    start_mpi();
    return model.solid.dimension == 2 ? initialise<2>(model, field, options, mesh_folder) :
                                        initialise<3>(model, field, options, mesh_folder);
  }

  RunResult continue_from(const RunRequest                &request,
                          const ContinuumModel            &model,
                          const coupling::ParticleField   &field,
                          const coupling::TransferOptions &options,
                          const double                     least_force,
                          const TransferObserver          &observe)
  {
    start_mpi();
    return model.solid.dimension == 2 ? run<2>(request, model, field, options, least_force, observe) :
                                        run<3>(request, model, field, options, least_force, observe);
  }
} // namespace apps
