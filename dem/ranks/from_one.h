#pragma once

#include "dem/ranks/ranks.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** Numbers of one rank, on all. @tparam Number a double, or an integer as wide */
  template <typename Number>
  void take_from(Ranks &ranks, const std::size_t rank, Number *const numbers, const std::size_t count)
  {
    static_assert(sizeof(Number) == sizeof(double), "what is gathered consists of whole doubles");
    std::vector<std::size_t> bytes(ranks.size() + 1, 0);
    for (std::size_t r = rank; r < ranks.size(); ++r)
      bytes[r + 1] = count * sizeof(Number);
    ranks.gather(numbers, bytes);
  }

  /** Those of the first. */
  template <typename Number>
  void take_from_first(Ranks &ranks, Number *const numbers, const std::size_t count)
  {
    take_from(ranks, 0, numbers, count);
  }
} // namespace dem
