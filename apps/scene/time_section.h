#pragma once

#include "apps/scene/section.h"

namespace apps
{
  /** Section "Time": how the motion is integrated. */
  struct TimeSection
  {
    // 0.8: below 1 the estimate is a proven bound, and the margin covers contacts that form between two checks of it.
    double step_factor = 0.8;
    // 0.3: the value of the published uniaxial tests; stress waves decay within a few crossings, and the damping force
    // stays a few per cent of the load (Stransky, 2018).
    double damping = 0.3;

    void declare(Section &root);
  };
} // namespace apps
