#include "apps/runs/quasi_static/run.h"

#include "apps/figures/lab_run.h"
#include "apps/process/mpi_session.h"
#include "apps/process/path_solver.h"
#include "apps/runs/quasi_static/report.h"

namespace apps
{
  RunResult run(const QuasiStaticModel &model, const RunRequest &request)
  {
    start_mpi_for_ranks();
    refuse_factor_on_ranks(base::EntryPath().at("Solver"), model.linear_solver);
    return LabRun<QuasiStaticLabTest>(request, model).execute();
  }
} // namespace apps
