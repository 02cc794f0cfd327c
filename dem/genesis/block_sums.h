#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dem
{
  /**
   * Sum (or whatever `join` does) over items in blocks, which threads share: the same bits for any number of threads.
   *
   * @param part (begin, end) -> Sum of a block @param join (Sum &all, const Sum &part)
   */
  template <typename Sum, typename Part, typename Join>
  Sum sum_of_blocks(const std::size_t items, const std::size_t block, const Part &part, const Join &join)
  {
    const auto       blocks = static_cast<std::ptrdiff_t>((items + block - 1) / block);
    std::vector<Sum> parts(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t b = 0; b < blocks; ++b)
      {
        const std::size_t begin            = static_cast<std::size_t>(b) * block;
        parts[static_cast<std::size_t>(b)] = part(begin, std::min(begin + block, items));
      }
    Sum all{};
    for (const Sum &each : parts)
      join(all, each);
    return all;
  }
} // namespace dem
