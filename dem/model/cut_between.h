#pragma once

#include "dem/model/packing.h"

#include <algorithm>
#include <tuple>

namespace dem
{
  /**
   * The cut between two particles; nullptr: no joint lies between them.
   * @param cuts sorted, as Packing::cuts @param one, other numbers of the particles in the packing
   */
  inline const JointCut *
  cut_between(const std::vector<JointCut> &cuts, const std::int32_t one, const std::int32_t other)
  {
    JointCut asked;
    std::tie(asked.first, asked.second) = std::minmax(one, other);
    const auto found                    = std::lower_bound(cuts.begin(), cuts.end(), asked);
    return found == cuts.end() || asked < *found ? nullptr : &*found;
  }
} // namespace dem
