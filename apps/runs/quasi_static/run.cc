#include "apps/runs/quasi_static/run.h"

#include "apps/figures/lab_run.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/quasi_static/report.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    /** A factor cannot be shared, and grips that turn need one. */
    void refuse_factor_on_ranks(const QuasiStaticModel &model)
    {
      if (rank_count() == 1)
        return;
      if (model.linear_solver == dem::SolverMethod::direct)
        base::EntryPath().at("Solver").refuse(
          "Linear solver", fmt::format("runs in one process, and mpirun has started {}. Choose automatic or "
                                       "iterative, or use --threads.",
                                       rank_count()));
      if (!model.is_cell() && model.grips_turn)
        base::EntryPath().at("Loading").refuse(
          "Grips turn",
          fmt::format("they need the direct solver, which runs in one process, and mpirun has started {}. "
                      "Use --threads.",
                      rank_count()));
    }
  } // namespace

  RunResult run(const QuasiStaticModel &model, const RunRequest &request)
  {
    start_mpi_for_ranks();
    refuse_factor_on_ranks(model);
    return LabRun<QuasiStaticLabTest>(request, model).execute();
  }
} // namespace apps
