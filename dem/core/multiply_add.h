#pragma once

#include "dem/core/inline.h"
#include "dem/core/vector_signs.h"

#include <cmath>
#include <cstddef>

/**
 * a b + c rounded once, by additions and products alone: for processors without the instruction (x86-64 before 2013), which so give
 * the same bits as others, at some thirty times the price of an operation.
 */
namespace dem
{
  namespace exact_parts
  {
    template <typename Vector>
    using Integers [[gnu::vector_size(sizeof(Vector))]] = long long;
    template <typename Vector>
    using Words [[gnu::vector_size(sizeof(Vector))]] = unsigned long long;

    /** A result and what rounding has added to it: rounded - excess is exact. An exact 0 has the excess +0, whatever its sign. */
    template <typename Vector>
    struct Result
    {
      Vector rounded, excess;
    };

    /** Knuth (1969), The Art of Computer Programming 2, 4.2.2, theorem B. */
    template <typename Vector>
    BRECCIA_KERNEL Result<Vector> sum(const Vector a, const Vector b)
    {
      const Vector s = a + b, of_b = s - a, of_a = s - of_b;
      return {s, (of_a - a) + (of_b - b)};
    }

    /** A number of which high has 26 bits and low the rest, with its sign: products of two such parts are exact. */
    template <typename Vector>
    struct Parts
    {
      Vector high, low;

      BRECCIA_KERNEL explicit Parts(const Vector a)
      {
        // As whole numbers, numbers of one sign have their order, so that carrying into the exponent is right.
        constexpr unsigned long long unit = 1ULL << 27;
        high = reinterpret_cast<Vector>((reinterpret_cast<Words<Vector>>(a) + unit / 2) & -unit);
        low  = a - high;
      }
    };

    /** Dekker's product: Dekker (1971), A floating-point technique for extending the available precision, (5.7). */
    template <typename Vector>
    BRECCIA_KERNEL Result<Vector> product(const Vector a, const Vector b)
    {
      const Parts<Vector> of_a(a), of_b(b);
      const Vector        p = a * b;
      return {p, ((p - of_a.high * of_b.high) - of_a.high * of_b.low - of_a.low * of_b.high) - of_a.low * of_b.low};
    }

    /** Where a is not 0 and below 2^-480: two that are not have a product of which no bit lies below the smallest number. */
    template <typename Vector>
    BRECCIA_KERNEL Integers<Vector> tiny(const Vector a)
    {
      // Twice a drops the sign, taking 1 makes 0 the largest; processors compare whole numbers with signs.
      constexpr unsigned long long first_sign = 1ULL << 63, limit = (1023ULL - 480) << 53;
      const Words<Vector>          bits = reinterpret_cast<Words<Vector>>(a);
      return reinterpret_cast<Integers<Vector>>(bits + bits + (first_sign - 1)) <
             static_cast<long long>(limit - 1 + first_sign);
    }

    /**
     * An excess with its last bit set where rounding has made it too small, as what that added has the other sign. It is then rounded to
     * odd as far as half a unit of the result is concerned, and taking it away rounds as if it were exact: Boldo, Melquiond (2008),
     * Emulation of FMA and correctly rounded sums, section IV.
     */
    template <typename Vector>
    BRECCIA_KERNEL Vector nudged(const Vector excess, const Vector added)
    {
      const auto bits = reinterpret_cast<Words<Vector>>(excess), of_added = reinterpret_cast<Words<Vector>>(added),
                 inexact = reinterpret_cast<Words<Vector>>(added != Vector{});
      return reinterpret_cast<Vector>(bits | (((bits ^ of_added) & inexact) >> 63));
    }

    template <typename Vector>
    BRECCIA_RARE Vector lane_by_lane(const Vector a, const Vector b, const Vector c)
    {
      Vector all{};
      for (std::size_t lane = 0; lane < sizeof(Vector) / sizeof(double); ++lane)
        all[lane] = std::fma(a[lane], b[lane], c[lane]);
      return all;
    }
  } // namespace exact_parts

  /**
   * Called, not inlined: a hundred copies of it in a kernel outgrow the cache of instructions, and the patience of a compiler.
   * @tparam Vector native, of doubles
   */
  template <typename Vector>
  BRECCIA_BRANCH Vector multiply_add_in_parts(const Vector a, const Vector b, const Vector c)
  {
    using exact_parts::Integers;
    const auto   product = exact_parts::product(a, b), high = exact_parts::sum(product.rounded, c);
    const Vector low = high.excess + product.excess, all = high.rounded - low, excess = (all - high.rounded) + low;
    // Rounded twice: the same as once but where the second time is a tie, which a little more rounds to another number. What is not
    // finite differs from everything.
    constexpr double       a_little_more = 1 + 0x1p-52;
    const Integers<Vector> tiny          = exact_parts::tiny(a) | exact_parts::tiny(b),
                           tie           = all - a_little_more * excess != all;
    if (__builtin_expect(native::any_signs(reinterpret_cast<Vector>(tie | tiny)), false))
      {
        if (native::any_signs(reinterpret_cast<Vector>(tiny | (all - all != Vector{}))))
          return exact_parts::lane_by_lane(a, b, c);
        return all - exact_parts::nudged(excess, exact_parts::sum(high.excess, product.excess).excess);
      }
    return all;
  }
} // namespace dem
