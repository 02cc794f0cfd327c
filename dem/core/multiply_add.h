#pragma once

#include "dem/core/inline.h"

/**
 * a b + c rounded once, by additions and products alone: for processors without the instruction (x86-64 before 2013), which so give
 * the same bits as others, at twenty times the price of an operation.
 */
namespace dem
{
  namespace exact_parts
  {
    template <typename Vector>
    struct Sum
    {
      Vector rounded, rest; ///< rounded + rest is exact
    };

    /** Knuth (1969), The Art of Computer Programming 2, 4.2.2, theorem B. */
    template <typename Vector>
    BRECCIA_KERNEL Sum<Vector> sum(const Vector a, const Vector b)
    {
      const Vector s = a + b, of_b = s - a, of_a = s - of_b;
      return {s, (a - of_a) + (b - of_b)};
    }

    /** Veltkamp's and Dekker's product: Dekker (1971), A floating-point technique for extending the available precision, (4.2), (5.7). */
    template <typename Vector>
    BRECCIA_KERNEL Sum<Vector> product(const Vector a, const Vector b)
    {
      constexpr double splitter = 0x1p27 + 1;
      const Vector     wide_a = splitter * a, wide_b = splitter * b;
      const Vector     high_a = wide_a - (wide_a - a), high_b = wide_b - (wide_b - b);
      const Vector     low_a = a - high_a, low_b = b - high_b, p = a * b;
      return {p, ((high_a * high_b - p) + high_a * low_b + low_a * high_b) + low_a * low_b};
    }

    /**
     * a + b rounded to odd: where it is not exact, the last bit is set, towards the exact sum. What is added to it later is then
     * rounded as if from the exact sum: Boldo, Melquiond (2008), Emulation of FMA and correctly rounded sums, section IV.
     */
    template <typename Vector>
    BRECCIA_KERNEL Vector sum_to_odd(const Vector a, const Vector b)
    {
      using Bits              = decltype(a > b);
      const Sum<Vector> exact = sum(a, b);
      const Bits bits = reinterpret_cast<Bits>(exact.rounded), inexact = exact.rest != Vector{}, even = (bits & 1) == 0;
      // One unit towards zero where the rest points there, one away from it where not: both end in an odd bit.
      const Bits towards_zero = (exact.rest > Vector{}) ^ (exact.rounded > Vector{});
      return reinterpret_cast<Vector>(bits + (inexact & even & (towards_zero ? Bits{} - 1 : Bits{} + 1)));
    }
  } // namespace exact_parts

  /**
   * @tparam Vector native, of doubles
   * @pre |a|, |b| < 2^970, and |a b| is 0 or above 2^-968: nothing that links or particles have comes near either
   */
  template <typename Vector>
  BRECCIA_KERNEL Vector multiply_add_in_parts(const Vector a, const Vector b, const Vector c)
  {
    const auto product = exact_parts::product(a, b), low = exact_parts::sum(c, product.rest),
               high = exact_parts::sum(product.rounded, low.rounded);
    return high.rounded + exact_parts::sum_to_odd(high.rest, low.rest);
  }
} // namespace dem
