#pragma once

#include "dem/model/packing.h"

#include <functional>
#include <string>

namespace dem
{
  /**
   * Refuse a packing that can be computed but is no body of particles, most often by a wrong unit or a wrong cell: two particles
   * (or a particle and an image) that overlap by more than three quarters of the smaller diameter, a packing that reaches
   * beyond its periodic cell by more than a particle, or particles of more volume than their cell.
   *
   * @param packing as check_packing() lets pass
   * @param origin where it came from, for the message
   * @param dimension 2: discs, which fill no volume
   * @param one_body whether two may overlap as they like; by default none do
   * @throws base::InputError naming the particles (counted from 1) and the lengths
   */
  void check_overlaps(const Packing                                       &packing,
                      const std::string                                   &origin,
                      int                                                  dimension,
                      const std::function<bool(std::size_t, std::size_t)> &one_body = {});
} // namespace dem
