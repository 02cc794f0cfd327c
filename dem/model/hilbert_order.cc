#include "dem/model/particles.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr int bits_per_axis = 20;

    /**
   * Place of a cell along the three-dimensional Hilbert curve.
   *
   * Coordinates are turned in place into the curve's transposed index (Skilling, 2004, AIP Conf. Proc. 707, 381), whose bits
   * are then interleaved.
   */
    std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x)
    {
      for (std::uint32_t q = 1u << (bits_per_axis - 1); q > 1; q >>= 1)
        for (auto &value : x)
          {
            const std::uint32_t low = q - 1;
            if (value & q)
              x[0] ^= low;
            else
              {
                const std::uint32_t exchange = (x[0] ^ value) & low;
                x[0] ^= exchange;
                value ^= exchange;
              }
          }
      x[1] ^= x[0];
      x[2] ^= x[1];
      std::uint32_t carry = 0;
      for (std::uint32_t q = 1u << (bits_per_axis - 1); q > 1; q >>= 1)
        if (x[2] & q)
          carry ^= q - 1;
      std::uint64_t index = 0;
      for (int bit = bits_per_axis - 1; bit >= 0; --bit)
        for (auto &value : x)
          index = (index << 1) | (((value ^ carry) >> bit) & 1u);
      return index;
    }
  } // namespace

  std::vector<std::int32_t> hilbert_order(const std::vector<Eigen::Vector3d> &points)
  {
    Eigen::Array3d low = points.front(), high = points.front();
    for (const auto &p : points)
      {
        low  = low.min(p.array());
        high = high.max(p.array());
      }
    const double edge  = std::max((high - low).maxCoeff(), 1e-300);
    const double scale = ((1u << bits_per_axis) - 1) / edge;

    std::vector<std::pair<std::uint64_t, std::int32_t>> keyed(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Eigen::Array3d cell = (points[i].array() - low) * scale;
        keyed[i] = {hilbert_index({static_cast<std::uint32_t>(cell[0]), static_cast<std::uint32_t>(cell[1]),
                                   static_cast<std::uint32_t>(cell[2])}),
                    static_cast<std::int32_t>(i)};
      }
    std::sort(keyed.begin(), keyed.end());
    std::vector<std::int32_t> order(points.size());
    std::transform(keyed.begin(), keyed.end(), order.begin(), [](const auto &k) { return k.second; });
    return order;
  }
} // namespace dem
