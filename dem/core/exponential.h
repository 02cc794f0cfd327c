#pragma once

#include "dem/core/simd.h"

#include <cstdint>
#include <cstring>

namespace dem
{
  /**
   * 2^k for an integer-valued k in [-1022, 1023], exact, by writing the exponent bits.
   *
   * k + 1023 + 2^52 has the biased exponent in its lowest bits; shifted up by 52 they are the bits of 2^k.
   */
  inline double power_of_two(const double k)
  {
    const double biased = k + (0x1p52 + 1023.0);
    std::int64_t bits;
    std::memcpy(&bits, &biased, sizeof(bits));
    bits = static_cast<std::int64_t>(static_cast<std::uint64_t>(bits) << 52);
    double result;
    std::memcpy(&result, &bits, sizeof(result));
    return result;
  }

  /**
   * Nearest integer, halves to even, of a number below 2^51 in magnitude: the sum with 1.5 * 2^52 has no digits behind the point.
   * No call and no instruction that a processor may lack, and the same for packs and single numbers.
   */
  template <typename T>
  BRECCIA_KERNEL T round_to_integer(const T &a)
  {
    constexpr double shift = 0x1.8p52;
    return (a + T(shift)) - T(shift);
  }

  /**
 * e^x for x <= 0, one number or eight with the same bits, within 2 units in the last place; 0 below -700.
 *
 * Argument reduction x = k ln 2 + r, |r| <= ln(2)/2, with ln 2 in two parts (Cody and Waite, 1980, Software Manual for the
 * Elementary Functions); e^r by its Taylor polynomial of degree 13, whose remainder is below 5e-18.
 */
  template <typename T>
  BRECCIA_KERNEL T exponential(const T &x)
  {
    constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33, log2_e = 0x1.71547652b82fep+0;
    const T          bounded = maximum(x, T(-700.0));
    const T          k       = round_to_integer(T(bounded * T(log2_e)));
    const T          r       = negative_multiply_add(k, T(ln2_low), negative_multiply_add(k, T(ln2_high), bounded));

    T series = T(1.0);
    for (int degree = 13; degree >= 1; --degree) // Horner: 1 + r (1 + r/2 (1 + r/3 (...)))
      series = multiply_add(series * r, T(1.0 / degree), T(1.0));
    return select(x < T(-700.0), T(0.0), T(series * power_of_two(k)));
  }
} // namespace dem
