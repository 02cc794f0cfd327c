#pragma once

#include "dem/peridynamics/bonds.h"

#include <cstdint>
#include <vector>

namespace dem::peridynamics
{
  /** Components of motion that are prescribed: by place, bit 1 for x, 2 for y, 4 for z. */
  using Held = std::vector<std::uint8_t>;

  /** What of a body's rigid motions nothing holds. */
  struct RigidMotions
  {
    Held   held; ///< with as few components more as hold every piece; a balanced load leaves no reaction there
    bool   free       = false; ///< some had to be added
    double imbalance  = 0; ///< of the load on what moves freely: over the sum of its magnitudes, of the worst piece [-]
    std::size_t loose = 0; ///< nodes of that piece
  };

  /** Piece by piece of what unbroken bonds hold together. @param load [N] */
  RigidMotions hold_rigid_motions(const Bonds &bonds, const Held &held, const Field &load);

  /** Take the mean displacement and the mean rotation, both weighted by volume, out of a small displacement. */
  void remove_rigid_motion(const Grid &grid, Field &u);
} // namespace dem::peridynamics
