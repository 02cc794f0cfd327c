#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace dem
{
  /**
   * Sums over items begin .. end - 1 in blocks, which threads share: those of each block, which do not depend on the number of threads.
   *
   * @param begin multiple of the block @param part (begin, end) -> Sum of a block
   */
  template <typename Sum, typename Part>
  std::vector<Sum>
  sums_of_blocks(const std::size_t begin, const std::size_t end, const std::size_t block, const Part &part)
  {
    const auto       blocks = static_cast<std::ptrdiff_t>((end - begin + block - 1) / block);
    std::vector<Sum> sums(static_cast<std::size_t>(blocks));
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t b = 0; b < blocks; ++b)
      {
        const std::size_t from            = begin + static_cast<std::size_t>(b) * block;
        sums[static_cast<std::size_t>(b)] = part(from, std::min(from + block, end));
      }
    return sums;
  }

  /**
   * Let a sum go from rank to rank, each of which joins its own to what the one before has left.
   *
   * @param relay (double *numbers, std::size_t count, go_on), that calls go_on where it is this rank's turn @param join (Sum &all)
   */
  template <typename Sum, typename Relay, typename Join>
  void hand_on(Sum &all, const Relay &relay, const Join &join)
  {
    static_assert(std::is_trivially_copyable_v<Sum> && sizeof(Sum) % sizeof(double) == 0, "a sum consists of doubles");
    std::array<double, sizeof(Sum) / sizeof(double)> numbers;
    std::memcpy(numbers.data(), &all, sizeof(Sum));
    relay(numbers.data(), numbers.size(), [&] {
      std::memcpy(static_cast<void *>(&all), numbers.data(), sizeof(Sum));
      join(all);
      std::memcpy(numbers.data(), &all, sizeof(Sum));
    });
    std::memcpy(static_cast<void *>(&all), numbers.data(), sizeof(Sum));
  }
} // namespace dem
