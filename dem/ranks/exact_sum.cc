#include "dem/ranks/exact_sum.h"

#include <cmath>
#include <limits>

namespace dem
{
  void ExactSum::add(const ExactSum &other)
  {
    ExactSum settled = other;
    settled.settle();
    for (std::size_t i = 0; i < limbs; ++i)
      limb[i] += settled.limb[i];
    specials |= settled.specials;
    if (--room == 0)
      settle();
  }

  void ExactSum::add_special(const double value)
  {
    specials |= std::isnan(value) ? no_number : value > 0 ? positive_infinity : negative_infinity;
  }

  /** Pass carries on: all limbs but the last, which has the sign, lie in [0, 2^32). */
  void ExactSum::settle()
  {
    std::int64_t carry = 0;
    for (std::size_t i = 0; i + 1 < limbs; ++i)
      {
        const std::int64_t all = limb[i] + carry;
        limb[i]                = all & limb_mask;
        carry                  = (all - limb[i]) / (limb_mask + 1);
      }
    limb[limbs - 1] += carry;
    room = settle_each;
  }

  double ExactSum::of_specials() const
  {
    if (specials == positive_infinity)
      return std::numeric_limits<double>::infinity();
    if (specials == negative_infinity)
      return -std::numeric_limits<double>::infinity();
    return std::numeric_limits<double>::quiet_NaN();
  }

  double ExactSum::value() const
  {
    if (specials != 0)
      return of_specials();
    ExactSum size = *this;
    size.settle();
    const bool negative = size.limb[limbs - 1] < 0;
    if (negative)
      {
        for (std::int64_t &each : size.limb)
          each = -each;
        size.settle();
      }
    const auto bit = [&](const int place) {
      return static_cast<std::uint64_t>(size.limb[static_cast<std::size_t>(place / limb_bits)] >> place % limb_bits &
                                        1);
    };
    int highest = static_cast<int>(limbs - 1) * limb_bits - 1;
    while (highest >= 0 && bit(highest) == 0)
      --highest;

    // The bits of a double, read as an integer, grow by one from each double to the next: rounding up may carry into the exponent.
    constexpr std::uint64_t infinite = std::uint64_t{0x7ff} << 52;
    const int               last     = highest > 52 ? highest - 52 : 0; // place of the last digit that the result has
    std::uint64_t           digits   = 0;
    for (int place = highest; place >= last; --place)
      digits = digits << 1 | bit(place);
    bool beyond_half = digits % 2 == 1; // of a tie, the even neighbour
    for (int place = 0; place < last - 1 && !beyond_half; ++place)
      beyond_half = bit(place) != 0;
    if (last > 0 && bit(last - 1) != 0 && beyond_half)
      ++digits;
    std::uint64_t bits = (static_cast<std::uint64_t>(last) << 52) + digits;
    if (size.limb[limbs - 1] != 0 || bits > infinite)
      bits = infinite;
    double magnitude;
    std::memcpy(&magnitude, &bits, sizeof(magnitude));
    return negative ? -magnitude : magnitude;
  }
} // namespace dem
