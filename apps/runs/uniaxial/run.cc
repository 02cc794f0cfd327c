#include "apps/runs/uniaxial/run.h"

#include "apps/figures/lab_run.h"
#include "apps/runs/uniaxial/report.h"

namespace apps
{
  RunResult run(const UniaxialModel &model, const RunRequest &request)
  {
    return LabRun<UniaxialLabTest>(request, model).execute();
  }
} // namespace apps
