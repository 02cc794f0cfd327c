#pragma once

#include "dem/loading/uniaxial.h"
#include "dem/model/link_law.h"
#include "dem/model/packing.h"

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

  /**
   * Strain at which a uniaxial test probably ends by its stop fraction, for forecasts of its duration; infinite if its links do not fail.
   *
   * In tension one crack opens, through links about a particle's diameter long, as their law softens; in compression the peak has
   * come at about twelve times the limit elastic strain of the links in concrete (doc/theory/laboratory-test.md), and the fall
   * behind it takes as long again.
   */
  double strain_of_failure(const dem::LinkLaw &law, const dem::Packing &packing, const dem::UniaxialParameters &test);
} // namespace apps
