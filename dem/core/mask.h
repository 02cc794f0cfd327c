#pragma once

#include "dem/core/native_vectors.h"

#include <utility>

namespace dem
{
  inline namespace BRECCIA_VECTORS
  {
    /** What a comparison of packs gives: all or no bits of each lane. */
    template <typename Number, int n, bool native = sizeof(Number) * n <= vector_bytes>
    struct MaskOf
    {
      using Half = MaskOf<Number, n / 2>;
      Half low, high;

      MaskOf() = default;
      BRECCIA_KERNEL MaskOf(const Half &first, const Half &second)
        : low(first)
        , high(second)
      {
      }
      BRECCIA_KERNEL explicit MaskOf(const bool all)
        : low(all)
        , high(all)
      {
      }
      BRECCIA_KERNEL friend MaskOf operator&&(const MaskOf &a, const MaskOf &b)
      {
        return {a.low && b.low, a.high && b.high};
      }
      BRECCIA_KERNEL friend MaskOf operator||(const MaskOf &a, const MaskOf &b)
      {
        return {a.low || b.low, a.high || b.high};
      }
      BRECCIA_KERNEL friend MaskOf operator!(const MaskOf &a) { return {!a.low, !a.high}; }
      BRECCIA_KERNEL friend bool   any(const MaskOf &a) { return any(a.low || a.high); }
    };

    template <typename Number, int n>
    struct MaskOf<Number, n, true>
    {
      using Vector [[gnu::vector_size(sizeof(Number) * n)]] = Number;
      using Integer                                         = decltype(std::declval<Vector>() > std::declval<Vector>());
      Integer v;

      MaskOf() = default;
      BRECCIA_KERNEL MaskOf(const Integer &lanes)
        : v(lanes)
      {
      }
      BRECCIA_KERNEL explicit MaskOf(const bool all)
        : v(Integer{} - (all ? 1 : 0))
      {
      }
      BRECCIA_KERNEL friend MaskOf operator&&(const MaskOf &a, const MaskOf &b) { return MaskOf(a.v & b.v); }
      BRECCIA_KERNEL friend MaskOf operator||(const MaskOf &a, const MaskOf &b) { return MaskOf(a.v | b.v); }
      BRECCIA_KERNEL friend MaskOf operator!(const MaskOf &a) { return MaskOf(~a.v); }
      BRECCIA_KERNEL friend bool   any(const MaskOf &a) { return native::any_signs(reinterpret_cast<Vector>(a.v)); }
    };

#if BRECCIA_VECTOR == 64
    /** AVX-512 has registers of bits for them. */
    template <>
    struct MaskOf<double, 8, true>
    {
      __mmask8 v;

      MaskOf() = default;
      BRECCIA_KERNEL MaskOf(const __mmask8 lanes)
        : v(lanes)
      {
      }
      BRECCIA_KERNEL explicit MaskOf(const bool all)
        : v(all ? 0xff : 0)
      {
      }
      BRECCIA_KERNEL friend MaskOf operator&&(const MaskOf &a, const MaskOf &b) { return _kand_mask8(a.v, b.v); }
      BRECCIA_KERNEL friend MaskOf operator||(const MaskOf &a, const MaskOf &b) { return _kor_mask8(a.v, b.v); }
      BRECCIA_KERNEL friend MaskOf operator!(const MaskOf &a) { return _knot_mask8(a.v); }
      BRECCIA_KERNEL friend bool   any(const MaskOf &a) { return a.v != 0; }
    };
#endif
  } // namespace BRECCIA_VECTORS
} // namespace dem
