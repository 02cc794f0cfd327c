#pragma once

#include "dem/model/packing.h"

#include <array>

namespace dem
{
  /** Regular arrangements of touching equal spheres, or of discs in the plane z = 0. */
  enum class Lattice
  {
    simple_cubic,       ///< 6 neighbours; cell edge 2r, 1 sphere, packing fraction pi/6
    body_centred_cubic, ///< 8 neighbours; cell edge 4r/sqrt(3), 2 spheres, pi sqrt(3)/8
    face_centred_cubic, ///< 12 neighbours; cell edge 2 sqrt(2) r, 4 spheres, pi/(3 sqrt(2))
    square,             ///< discs, 4 neighbours; cell 2r x 2r, 1 disc, area fraction pi/4
    hexagonal           ///< discs, 6 neighbours; cell 2r x 2 sqrt(3) r, 2 discs, area fraction pi/(2 sqrt(3))
  };

  /**
   * Periodic packing of a lattice, for tests and homogenisation.
   *
   * The first centre lies at (r, r, r), or (r, r, 0) for discs. The cell of discs has an infinite third edge: it does not
   * repeat along z.
   *
   * @param radius [m], > 0
   * @param cells  number of lattice cells along x, y, z, >= 1; the third is 1 for discs
   * @throws base::InputError for other values.
   */
  Packing make_lattice(Lattice lattice, double radius, const std::array<int, 3> &cells);
} // namespace dem
