#include "apps/runs/quasi_static/run.h"

#include "apps/figures/lab_run.h"
#include "apps/process/mpi_session.h"
#include "apps/process/path_solver.h"
#include "apps/runs/quasi_static/report.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    /** They need a factor, which cannot be shared. */
    void refuse_turning_grips_on_ranks(const QuasiStaticModel &model)
    {
      if (rank_count() > 1 && !model.is_cell() && model.grips_turn)
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
    refuse_factor_on_ranks(base::EntryPath().at("Solver"), model.linear_solver);
    refuse_turning_grips_on_ranks(model);
    return LabRun<QuasiStaticLabTest>(request, model).execute();
  }
} // namespace apps
