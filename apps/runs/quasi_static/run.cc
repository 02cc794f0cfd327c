#include "apps/runs/quasi_static/run.h"

#include "apps/figures/lab_run.h"
#include "apps/runs/quasi_static/report.h"

namespace apps
{
  RunResult run(const QuasiStaticModel &model, const RunRequest &request)
  {
    return LabRun<QuasiStaticLabTest>(request, model).execute();
  }
} // namespace apps
