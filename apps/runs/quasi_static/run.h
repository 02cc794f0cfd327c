#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/quasi_static/model.h"

namespace apps
{
  /** Do the work of a checked model. Throws as Scene::run(). */
  RunResult run(const QuasiStaticModel &model, const RunRequest &request);
} // namespace apps
