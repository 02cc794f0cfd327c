#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/homogenisation/model.h"

namespace apps
{
  /** Work of a checked model; in the result folder homogenised.csv, homogenised.png, summary.json, scene.prm. Throws as Scene::run(). */
  RunResult run(const HomogenisationModel &model, const RunRequest &request);
} // namespace apps
