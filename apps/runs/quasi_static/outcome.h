#pragma once

#include "apps/results/run_outcome.h"
#include "apps/runs/quasi_static/model.h"

namespace apps
{
  /** What a run of a checked model can find. */
  RunOutcome outcome(const QuasiStaticModel &model);
} // namespace apps
