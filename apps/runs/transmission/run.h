#pragma once

#include "apps/results/run_request.h"
#include "apps/results/run_result.h"
#include "apps/runs/transmission/model.h"

namespace apps
{
  /** Work of a checked model; in the result folder reflection.csv, reflection.png, summary.json, scene.prm. Throws as Scene::run(). */
  RunResult run(const TransmissionModel &model, const RunRequest &request);
} // namespace apps
