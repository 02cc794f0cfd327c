#pragma once

#include "apps/runs/coupled/body.h"

#include <string>

namespace apps
{
  /**
   * What an impact on the solid would lose if it came with the steps of now (doc/theory/surface-coupling.md, 2), as a line of a forecast: of
   * the particle that loses the largest part. "" where both sides take the same steps, or none of the contacts acts at a point.
   */
  std::string sub_cycling_forecast(const CoupledModel &model, CoupledBody &body);
} // namespace apps
