#pragma once

#include <algorithm>
#include <cstddef>

namespace dem
{
  /** Call use(begin, end) for some lines, of links or particles, so few at a time that what is found of them takes little memory. */
  template <typename Use>
  void each_few_lines(const std::size_t begin, const std::size_t end, const Use &use)
  {
    constexpr std::size_t few = std::size_t(1) << 15;
    for (std::size_t at = begin; at < end; at += few)
      use(at, std::min(at + few, end));
  }
} // namespace dem
