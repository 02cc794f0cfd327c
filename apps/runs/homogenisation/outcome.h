#pragma once

#include "apps/results/run_outcome.h"
#include "apps/runs/homogenisation/model.h"

namespace apps
{
  /** What a run of a checked model can find. */
  RunOutcome outcome(const HomogenisationModel &model);
} // namespace apps
