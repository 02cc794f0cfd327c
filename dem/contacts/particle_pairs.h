#pragma once

#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"

namespace dem
{
  /**
   * Pairs of the particles where they are now, nearer than factor (r_J + r_K) + skin; in a periodic cell every image is a pair of its
   * own. Numbers are those of the particles' order. @param of whose pairs @throws as find_pairs()
   */
  std::vector<NeighbourPair>
  particle_pairs(const Particles &particles, double factor, double skin, const PairsOf &of = {});
} // namespace dem
