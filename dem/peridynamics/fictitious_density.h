#pragma once

#include "dem/peridynamics/bonds.h"

namespace dem::peridynamics
{
  /**
   * Gershgorin's bound of the stiffness per volume, by place: no squared frequency of a node of unit density is above it [N/m^4]. The largest
   * sum of magnitudes in a node's rows of the assembled matrix, with the bonds as they are, in their directions at rest; it does not grow when
   * bonds break. 1 where there is no node.
   */
  base::Column bound_of_stiffness(const Bonds &bonds);

  /** Of the published example programs: 5 times the volume of a whole family times the bond constant over the spacing [N/m^4]: Madenci, Oterkus (2014), chapter 7. */
  double constant_bound(const Bonds &bonds);
} // namespace dem::peridynamics
