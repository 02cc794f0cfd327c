#include "apps/runs/uniaxial/run.h"

#include "apps/figures/lab_run.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/uniaxial/report.h"

namespace apps
{
  RunResult run(const UniaxialModel &model, const RunRequest &request)
  {
    start_mpi_for_ranks();
    return LabRun<UniaxialLabTest>(request, model).execute();
  }
} // namespace apps
