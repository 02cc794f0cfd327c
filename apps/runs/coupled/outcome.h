#pragma once

#include "apps/results/run_outcome.h"
#include "apps/runs/coupled/model.h"

namespace apps
{
  /** What a run of a checked model can find. @throws base::InputError as a run */
  RunOutcome outcome(const CoupledModel &model);
} // namespace apps
