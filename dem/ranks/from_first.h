#pragma once

#include "dem/ranks/ranks.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** Numbers of the first rank, on all. @tparam Number a double, or an integer as wide */
  template <typename Number>
  void take_from_first(Ranks &ranks, Number *const numbers, const std::size_t count)
  {
    static_assert(sizeof(Number) == sizeof(double), "what is gathered consists of whole doubles");
    std::vector<std::size_t> bytes(ranks.size() + 1, count * sizeof(Number));
    bytes.front() = 0;
    ranks.gather(numbers, bytes);
  }
} // namespace dem
