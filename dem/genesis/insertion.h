#pragma once

#include "dem/genesis/vessel.h"
#include "dem/model/packing.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** Particles at random places, and how well that went. */
  struct Insertion
  {
    Packing      packing;
    std::int64_t draws    = 0; ///< places that were tried
    std::size_t  overlaps = 0; ///< particles that found no free place, and lie at the last one tried
  };

  /**
   * Put particles of these radii at random places inside a vessel, the largest first, none overlapping another: each is drawn again until
   * it is free (doc/theory/genesis.md, 1). Particles of several sizes are found in one grid per size, so that small ones among
   * large ones are found as fast as among their like.
   *
   * @param radii [m]; the packing has them in descending order @param attempts per particle, after which it may overlap
   * @throws base::InputError for a particle that the vessel is too small for
   */
  Insertion
  insert_at_random(const Vessel &vessel, std::vector<double> radii, std::uint64_t seed, std::int64_t attempts = 10000);
} // namespace dem
