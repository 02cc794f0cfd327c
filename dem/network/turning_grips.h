#pragma once

#include "dem/network/loaded_network.h"

namespace dem
{
  /**
   * Lets both grips turn, as platens on spherical seats do: each about the middle of its particles, which keep on a plane; its mean motion
   * is still that of the driven parameter (doc/theory/laboratory-test.md, 1). Particles whose spin is blocked turn with their grip.
   *
   * @param loaded by load_grips() with these grips, nothing tied yet
   * @throws base::InputError unless the grips hold their particles sideways, without which the specimen would fall over; or where the
   *         particles of a grip lie on a line, in the plane at a point, so that it has no face
   */
  void let_grips_turn(LoadedNetwork &loaded, const GripPair &grips);
} // namespace dem
