#pragma once

#include "dem/model/packing.h"

#include <cstddef>
#include <cstdint>

namespace dem
{
  /**
   * Random sequential placement: equal spheres one after the other at uniformly random places of a periodic cell, each
   * drawn again until it overlaps none before it. Beyond a packing fraction of about 0.38 there is no place left (Talbot,
   * Schaaf, Tarjus, 1991, Mol. Phys. 72, 1397); 0.31 takes some tens of draws per sphere.
   *
   * @param edges of the cell [m]
   * @throws base::InputError if a sphere finds no place in 100000 draws, or is larger than the cell.
   */
  Packing place_sequentially(std::size_t count, double radius, const Eigen::Vector3d &edges, std::uint64_t seed);
} // namespace dem
