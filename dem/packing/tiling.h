#pragma once

#include "dem/model/packing.h"

#include <array>
#include <cstdint>
#include <string>

namespace dem
{
  struct Tiling
  {
    Packing                     packing; ///< free, in the box [0, box]
    std::array<std::int64_t, 3> repeats; ///< of the periodic cell along each direction; 1 for a free packing
    std::string                 note;    ///< what the user should know (a short period), or empty
  };

  /**
   * Fill a box with a packing (doc/theory/packing.md, 2): repeat the periodic cell until it covers the box, then keep the
   * spheres that lie fully inside, x >= r and x <= box - r along each direction (touching counts as inside, up to a billionth
   * of r for round-off). A free packing is only cropped.
   *
   * Particles are numbered anew: cell by cell (x fastest), within a cell in the packing's order.
   *
   * @param box edge lengths [m]; an infinite one: not cropped along it (the third of discs)
   * @throws base::InputError if an edge is not above zero, nothing remains, a periodic packing would have to be repeated without
   *         end, or the result had more than 2^31 - 1 spheres.
   */
  Tiling tile_and_crop(const Packing &packing, const Eigen::Vector3d &box);
} // namespace dem
