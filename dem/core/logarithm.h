#pragma once

#include "dem/core/simd.h"

#include <cstdint>
#include <cstring>

namespace dem
{
  /** k of x = 2^k m with 1 <= m < 2, of a normal number above zero: its exponent bits. */
  inline double binary_exponent(const double x)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    return static_cast<double>(static_cast<std::int64_t>(bits >> 52) - 1023);
  }

  /** m of the same. */
  inline double binary_mantissa(const double x)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    bits = (bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL;
    double mantissa;
    std::memcpy(&mantissa, &bits, sizeof(mantissa));
    return mantissa;
  }

  /**
   * ln x for normal numbers above zero, one number or eight with the same bits, within 4 units in the last place.
   *
   * x = 2^k m with m between the roots of 1/2 and 2, and ln m = 2 (s + s^3/3 + s^5/5 + ...) with s = (m - 1)/(m + 1), |s| < 0.1716, up to
   * s^23, whose remainder is below 1e-20; ln 2 in two parts (Cody and Waite, 1980, Software Manual for the Elementary Functions).
   */
  template <typename T>
  BRECCIA_KERNEL T logarithm(const T &x)
  {
    constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33,
                     root_of_two = 0x1.6a09e667f3bcdp+0;
    T          k                 = each_lane(x, [](const double a) { return binary_exponent(a); });
    T          m                 = each_lane(x, [](const double a) { return binary_mantissa(a); });
    const auto upper             = m > T(root_of_two);
    k                            = select(upper, k + T(1.0), k);
    m                            = select(upper, T(0.5) * m, m);
    const T s = (m - T(1.0)) / (m + T(1.0)), square = s * s;
    T       series = T(1.0 / 23.0);
    for (int odd = 21; odd >= 1; odd -= 2)
      series = multiply_add(series, square, T(1.0 / odd));
    return multiply_add(k, T(ln2_high), multiply_add(k, T(ln2_low), T(2.0) * s * series));
  }
} // namespace dem
