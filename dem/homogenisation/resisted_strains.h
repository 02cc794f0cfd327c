#pragma once

#include "dem/homogenisation/macroscopic_stiffness.h"

namespace dem
{
  /** How many independent strains there are: 6, in the plane 3. */
  constexpr int strains_of(const int dimension) { return dimension == 3 ? 6 : 3; }

  /**
   * Make the stiffness exactly zero in the strains that a cell does not resist, where what was computed is rounding only: below
   * negligible_stiffness of the upper bound's largest. A stiffness without such strains keeps every bit.
   *
   * @param D     changed in place
   * @param bound of the same cell, affine_stiffness()
   * @return how many independent strains the cell resists
   */
  int remove_unresisted(MacroscopicStiffness &D, const MacroscopicStiffness &bound, int dimension);
} // namespace dem
