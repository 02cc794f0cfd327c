#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dem
{
  /**
   * Sum of doubles without any loss, rounded once, to the nearest double (ties to even), when it is read. So the order of additions, and how
   * they are split among threads or ranks, change no bit (doc/theory/ranks.md, 2).
   *
   * A fixed-point number wide enough for every double (Kulisch and Miranker, 1986, SIAM Review 28, 1), in limbs of 32 bits that are kept in
   * 64: carries wait for 2^30 additions. Two sums are added limb by limb, as integers.
   */
  class ExactSum
  {
  public:
    void add(double value);
    void add(const ExactSum &other);

    /**
     * The sum as the nearest double. Beyond the largest double by more than half a last digit: infinite, by its sign. An exact zero is +0.
     * Infinities and NaN that were added are kept, as IEEE 754 adds them: an infinity, or NaN where both signs or a NaN occurred.
     */
    double value() const;

  private:
    static constexpr std::size_t limbs =
      67; ///< bits of all doubles and their carries: 2098 in 66, and one for what overflows
    static constexpr int          limb_bits   = 32;
    static constexpr std::int64_t limb_mask   = (std::int64_t{1} << limb_bits) - 1;
    static constexpr std::int32_t settle_each = std::int32_t{1} << 30;

    enum Special : unsigned
    {
      no_number         = 1,
      positive_infinity = 2,
      negative_infinity = 4
    };

    void   add_special(double value);
    void   settle();
    double of_specials() const;

    /** The sum is that of limb[i] 2^(32 i - 1074). */
    std::array<std::int64_t, limbs> limb{};
    std::int32_t                    room     = settle_each; ///< additions until carries must be passed on
    unsigned                        specials = 0;           ///< which have been added
  };

  inline void ExactSum::add(const double value)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    const std::uint64_t exponent = bits >> 52 & 0x7ff;
    if (exponent == 0x7ff)
      return add_special(value);
    const std::uint64_t normal   = exponent != 0;
    const std::uint64_t mantissa = (bits & 0xfffffffffffff) | normal << 52;
    const std::uint64_t place    = exponent - normal; // of the mantissa's last bit, from that of the smallest double
    const auto          shift    = place % limb_bits;
    const auto          sign     = -static_cast<std::int64_t>(bits >> 63);
    const auto          part     = [&](const std::uint64_t magnitude) {
      return ((static_cast<std::int64_t>(magnitude) & limb_mask) ^ sign) - sign;
    };
    std::int64_t *to = &limb[place / limb_bits];
    to[0] += part(mantissa << shift);
    to[1] += part(mantissa >> (limb_bits - shift));
    to[2] += part(mantissa >> limb_bits >> (limb_bits - shift));
    if (--room == 0)
      settle();
  }
} // namespace dem
