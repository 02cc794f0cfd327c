#pragma once

#include "dem/core/mask.h"

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

/**
 * Eight doubles at a time, and the few functions that let one source serve a single number and a pack of eight.
 *
 * Kernels and laws are templates over the number type T: `double` in the one-link driver and in set-up code, `Pack` in the
 * explicit kernel. Only correctly rounded operations (+ - * / sqrt, fused multiply-add) and our own exp() are used, so a link's result depends neither
 * on its place in the pack nor on the width of the processor's vectors; sums over a pack are formed by halves for the same reason.
 *
 * A pack is one native vector where that is wide enough, else two packs of half the size as members: what is small enough lives in
 * registers, which arrays and loops over sections would not. Everything is inlined always; no call may be left in a kernel.
 */
namespace dem
{
  constexpr int pack_size = 8;

  inline namespace BRECCIA_VECTORS
  {
    /** n numbers, of two halves. */
    template <typename Number, int n, bool native = sizeof(Number) * n <= vector_bytes>
    struct PackOf
    {
      using Half = PackOf<Number, n / 2>;
      using Mask = MaskOf<Number, n>;
      Half low, high;

      PackOf() = default;
      // Half by half: where several are copied together as plain memory, a compiler may call memcpy for it.
      BRECCIA_KERNEL PackOf(const PackOf &other)
        : low(other.low)
        , high(other.high)
      {
      }
      BRECCIA_KERNEL PackOf &operator=(const PackOf &other)
      {
        low  = other.low;
        high = other.high;
        return *this;
      }
      BRECCIA_KERNEL PackOf(const Half &first, const Half &second)
        : low(first)
        , high(second)
      {
      }
      BRECCIA_KERNEL PackOf(const Number all)
        : low(all)
        , high(all)
      {
      }
      BRECCIA_KERNEL static PackOf load(const Number *from) { return {Half::load(from), Half::load(from + n / 2)}; }
      BRECCIA_KERNEL static PackOf load_unaligned(const Number *from)
      {
        return {Half::load_unaligned(from), Half::load_unaligned(from + n / 2)};
      }
      BRECCIA_KERNEL void store(Number *to) const
      {
        low.store(to);
        high.store(to + n / 2);
      }
      BRECCIA_KERNEL void store_unaligned(Number *to) const
      {
        low.store_unaligned(to);
        high.store_unaligned(to + n / 2);
      }
      BRECCIA_KERNEL void stream(Number *to) const
      {
        low.stream(to);
        high.stream(to + n / 2);
      }
      BRECCIA_KERNEL Number operator[](const int lane) const { return lane < n / 2 ? low[lane] : high[lane - n / 2]; }

      BRECCIA_KERNEL friend PackOf operator+(const PackOf &a, const PackOf &b)
      {
        return {a.low + b.low, a.high + b.high};
      }
      BRECCIA_KERNEL friend PackOf operator-(const PackOf &a, const PackOf &b)
      {
        return {a.low - b.low, a.high - b.high};
      }
      BRECCIA_KERNEL friend PackOf operator*(const PackOf &a, const PackOf &b)
      {
        return {a.low * b.low, a.high * b.high};
      }
      BRECCIA_KERNEL friend PackOf operator/(const PackOf &a, const PackOf &b)
      {
        return {a.low / b.low, a.high / b.high};
      }
      BRECCIA_KERNEL friend PackOf operator-(const PackOf &a) { return {-a.low, -a.high}; }
      BRECCIA_KERNEL friend Mask   operator>(const PackOf &a, const PackOf &b)
      {
        return {a.low > b.low, a.high > b.high};
      }
      BRECCIA_KERNEL friend Mask operator>=(const PackOf &a, const PackOf &b)
      {
        return {a.low >= b.low, a.high >= b.high};
      }
      BRECCIA_KERNEL friend Mask operator<(const PackOf &a, const PackOf &b) { return b > a; }
      BRECCIA_KERNEL friend Mask operator<=(const PackOf &a, const PackOf &b) { return b >= a; }

      BRECCIA_KERNEL friend PackOf select(const Mask &mask, const PackOf &yes, const PackOf &no)
      {
        return {select(mask.low, yes.low, no.low), select(mask.high, yes.high, no.high)};
      }
      BRECCIA_KERNEL friend PackOf maximum(const PackOf &a, const PackOf &b)
      {
        return {maximum(a.low, b.low), maximum(a.high, b.high)};
      }
      BRECCIA_KERNEL friend PackOf minimum(const PackOf &a, const PackOf &b)
      {
        return {minimum(a.low, b.low), minimum(a.high, b.high)};
      }
      BRECCIA_KERNEL friend PackOf square_root(const PackOf &a) { return {square_root(a.low), square_root(a.high)}; }
      BRECCIA_KERNEL friend PackOf multiply_add(const PackOf &a, const PackOf &b, const PackOf &c)
      {
        return {multiply_add(a.low, b.low, c.low), multiply_add(a.high, b.high, c.high)};
      }
      BRECCIA_KERNEL friend PackOf multiply_subtract(const PackOf &a, const PackOf &b, const PackOf &c)
      {
        return {multiply_subtract(a.low, b.low, c.low), multiply_subtract(a.high, b.high, c.high)};
      }
      BRECCIA_KERNEL friend PackOf negative_multiply_add(const PackOf &a, const PackOf &b, const PackOf &c)
      {
        return {negative_multiply_add(a.low, b.low, c.low), negative_multiply_add(a.high, b.high, c.high)};
      }
      BRECCIA_KERNEL friend PackOf power_of_two(const PackOf &k) { return {power_of_two(k.low), power_of_two(k.high)}; }
    };

    /** n numbers in one vector of the processor: the end of halving. */
    template <typename Number, int n>
    struct PackOf<Number, n, true>
    {
      using Vector [[gnu::vector_size(sizeof(Number) * n)]]                                                  = Number;
      using Unaligned [[gnu::vector_size(sizeof(Number) * n), gnu::aligned(sizeof(Number)), gnu::may_alias]] = Number;
      using Mask = MaskOf<Number, n>;
      Vector v;

      PackOf() = default;
      BRECCIA_KERNEL PackOf(const Vector &lanes)
        : v(lanes)
      {
      }
      BRECCIA_KERNEL PackOf(const Number all)
        : v(all - Vector{}) // less zero, not plus: -0 stays what it is
      {
      }
      BRECCIA_KERNEL static PackOf load(const Number *from) { return *reinterpret_cast<const Vector *>(from); }
      BRECCIA_KERNEL static PackOf load_unaligned(const Number *from)
      {
        return Vector(*reinterpret_cast<const Unaligned *>(from));
      }
      BRECCIA_KERNEL void   store(Number *to) const { *reinterpret_cast<Vector *>(to) = v; }
      BRECCIA_KERNEL void   store_unaligned(Number *to) const { *reinterpret_cast<Unaligned *>(to) = v; }
      BRECCIA_KERNEL void   stream(Number *to) const { native::stream(v, to); }
      BRECCIA_KERNEL Number operator[](const int lane) const { return v[lane]; }

      BRECCIA_KERNEL friend PackOf operator+(const PackOf &a, const PackOf &b) { return PackOf(a.v + b.v); }
      BRECCIA_KERNEL friend PackOf operator-(const PackOf &a, const PackOf &b) { return PackOf(a.v - b.v); }
      BRECCIA_KERNEL friend PackOf operator*(const PackOf &a, const PackOf &b) { return PackOf(a.v * b.v); }
      BRECCIA_KERNEL friend PackOf operator/(const PackOf &a, const PackOf &b) { return PackOf(a.v / b.v); }
      BRECCIA_KERNEL friend PackOf operator-(const PackOf &a) { return PackOf(-a.v); }
      BRECCIA_KERNEL friend Mask operator>(const PackOf &a, const PackOf &b) { return Mask(native::greater(a.v, b.v)); }
      BRECCIA_KERNEL friend Mask operator>=(const PackOf &a, const PackOf &b)
      {
        return Mask(native::not_less(a.v, b.v));
      }
      BRECCIA_KERNEL friend Mask operator<(const PackOf &a, const PackOf &b) { return b > a; }
      BRECCIA_KERNEL friend Mask operator<=(const PackOf &a, const PackOf &b) { return b >= a; }

      BRECCIA_KERNEL friend PackOf select(const Mask &mask, const PackOf &yes, const PackOf &no)
      {
        return PackOf(native::select(mask.v, yes.v, no.v));
      }
      BRECCIA_KERNEL friend PackOf maximum(const PackOf &a, const PackOf &b)
      {
        return PackOf(native::maximum(a.v, b.v));
      }
      BRECCIA_KERNEL friend PackOf minimum(const PackOf &a, const PackOf &b)
      {
        return PackOf(native::minimum(a.v, b.v));
      }
      BRECCIA_KERNEL friend PackOf square_root(const PackOf &a) { return PackOf(native::square_root(a.v)); }
      BRECCIA_KERNEL friend PackOf multiply_add(const PackOf &a, const PackOf &b, const PackOf &c)
      {
        return PackOf(native::multiply_add(a.v, b.v, c.v));
      }
      BRECCIA_KERNEL friend PackOf multiply_subtract(const PackOf &a, const PackOf &b, const PackOf &c)
      {
        return PackOf(native::multiply_subtract(a.v, b.v, c.v));
      }
      BRECCIA_KERNEL friend PackOf negative_multiply_add(const PackOf &a, const PackOf &b, const PackOf &c)
      {
        return PackOf(native::negative_multiply_add(a.v, b.v, c.v));
      }
      /** See power_of_two(double) in dem/core/exponential.h. */
      BRECCIA_KERNEL friend PackOf power_of_two(const PackOf &k)
      {
        using Bits [[gnu::vector_size(sizeof(Number) * n)]] = unsigned long long;
        return PackOf(reinterpret_cast<Vector>(reinterpret_cast<Bits>(k.v + (0x1p52 + 1023.0)) << 52));
      }
    };

    template <typename Number, int n>
    BRECCIA_KERNEL PackOf<Number, n> &operator+=(PackOf<Number, n> &a, const PackOf<Number, n> &b)
    {
      return a = a + b;
    }
    template <typename Number, int n>
    BRECCIA_KERNEL PackOf<Number, n> &operator-=(PackOf<Number, n> &a, const PackOf<Number, n> &b)
    {
      return a = a - b;
    }
    template <typename Number, int n>
    BRECCIA_KERNEL PackOf<Number, n> &operator*=(PackOf<Number, n> &a, const std::common_type_t<PackOf<Number, n>> &b)
    {
      return a = a * b;
    }

    using Pack     = PackOf<double, pack_size>;
    using PackMask = Pack::Mask;

    // So that they are found by their full names, too.
    bool any(const PackMask &a);
    Pack select(const PackMask &mask, const Pack &yes, const Pack &no);
    Pack maximum(const Pack &a, const Pack &b);
    Pack minimum(const Pack &a, const Pack &b);
    Pack square_root(const Pack &a);
    Pack multiply_add(const Pack &a, const Pack &b, const Pack &c);
    Pack multiply_subtract(const Pack &a, const Pack &b, const Pack &c);
    Pack negative_multiply_add(const Pack &a, const Pack &b, const Pack &c);
  } // namespace BRECCIA_VECTORS

  /** Four doubles: a record with room for one vector. */
  constexpr int half_record_size = pack_size / 2;
  using HalfPack                 = PackOf<double, half_record_size>;

  BRECCIA_KERNEL HalfPack low_half(const Pack &all)
  {
#if BRECCIA_VECTOR == 64
    return HalfPack(__builtin_shufflevector(all.v, all.v, 0, 1, 2, 3));
#else
    return all.low;
#endif
  }
  BRECCIA_KERNEL HalfPack high_half(const Pack &all)
  {
#if BRECCIA_VECTOR == 64
    return HalfPack(__builtin_shufflevector(all.v, all.v, 4, 5, 6, 7));
#else
    return all.high;
#endif
  }

  BRECCIA_KERNEL Pack load(const double *from) { return Pack::load(from); }
  BRECCIA_KERNEL void store(const Pack &values, double *to) { values.store(to); }

  BRECCIA_KERNEL HalfPack load_half(const double *from) { return HalfPack::load(from); }

  /** A pack of what a function says of each lane. */
  template <typename Function>
  Pack pack_of(Function &&f)
  {
    alignas(64) double lanes[pack_size];
    for (int lane = 0; lane < pack_size; ++lane)
      lanes[lane] = f(lane);
    return load(lanes);
  }

  /** Sum of all lanes, half added to half. */
  BRECCIA_KERNEL double sum_of(const Pack &a)
  {
    const HalfPack four = low_half(a) + high_half(a);
    return (four[0] + four[2]) + (four[1] + four[3]);
  }

  BRECCIA_KERNEL double select(const bool mask, const double yes, const double no) { return mask ? yes : no; }

  /** What a comparison of two T gives: bool, or one bit per lane. */
  template <typename T>
  using Comparison = decltype(std::declval<T>() > std::declval<T>());

  BRECCIA_KERNEL bool   any(const bool mask) { return mask; }
  BRECCIA_KERNEL double maximum(const double a, const double b) { return a > b ? a : b; }
  BRECCIA_KERNEL double minimum(const double a, const double b) { return a < b ? a : b; }
  BRECCIA_KERNEL double square_root(const double a) { return std::sqrt(a); }

  /** a b + c, rounded once: the one contraction that there is, for the compiler makes none by itself. Likewise a b - c and c - a b. */
  BRECCIA_KERNEL double multiply_add(const double a, const double b, const double c) { return std::fma(a, b, c); }
  BRECCIA_KERNEL double multiply_subtract(const double a, const double b, const double c) { return std::fma(a, b, -c); }
  BRECCIA_KERNEL double negative_multiply_add(const double a, const double b, const double c)
  {
    return std::fma(-a, b, c);
  }

  /** Apply a function of one double to every lane. */
  template <typename Function>
  double each_lane(const double a, Function &&f)
  {
    return f(a);
  }
  template <typename Function>
  Pack each_lane(const Pack &a, Function &&f)
  {
    return pack_of([&](const int lane) { return f(a[lane]); });
  }
} // namespace dem
