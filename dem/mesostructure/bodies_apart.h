#pragma once

#include "dem/model/packing.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * Numbers from 0, as few as a greedy choice finds, for aggregates, so that two with particles near each other have different ones: links
   * between particles of one number are then inside an aggregate.
   *
   * @param aggregate of each particle, or in_mortar @param reach near: distance below reach times the sum of the radii
   * @return of each aggregate
   */
  std::vector<std::int32_t> numbers_apart(const Packing                   &packing,
                                          const std::vector<std::int32_t> &aggregate,
                                          std::size_t                      aggregates,
                                          double                           reach);
} // namespace dem
