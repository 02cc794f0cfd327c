#pragma once

#include "apps/text/expression.h"
#include "base/entry_path.h"

namespace apps
{
  /** Section "Time": how the motion is integrated. */
  struct TimeSection
  {
    // 0.8: below 1 the estimate is a proven bound, and the margin covers contacts that form between two checks of it.
    double step_factor = 0.8;
    // 0.3: the value of the published uniaxial tests; stress waves decay within a few crossings, and the damping force
    // stays a few per cent of the load (Stransky, 2018).
    double     damping = 0.3;
    Expression damping_in_time; ///< of t alone; where it is given it goes before

    /** @throws base::InputError for a formula of place. */
    void check_by_time(const base::EntryPath &root) const;
    /** Damping at a time [s]. @throws base::InputError for a formula that leaves [0, 1) */
    double damping_at(double time) const;
  };
} // namespace apps
