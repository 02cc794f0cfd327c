#pragma once

#include "dem/model/link_law.h"

namespace apps
{
  /** How links fail in tension, for forecasts: the longest of all pairs of materials. Zero for a law that does not fail. */
  struct LinkFailure
  {
    double onset     = 0; ///< strain of the largest stress
    double softening = 0; ///< further strain over which the stress falls to 1/e of that; 0: at once
  };

  /** Found by pulling one link of each pair apart. @param law in space, see dem::LinkMaterials::bonds_in_space() */
  LinkFailure failure_in_tension(const dem::LinkLaw &law);
} // namespace apps
