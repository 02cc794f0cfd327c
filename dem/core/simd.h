#pragma once

#include "dem/core/inline.h"

#include <cmath>
#include <experimental/simd>
#include <utility>

/**
 * Eight doubles at a time, and the few functions that let one source serve a single number and a pack of eight.
 *
 * Kernels and laws are templates over the number type T: `double` in the one-link driver and in set-up code, `Pack` in the
 * explicit kernel. Only correctly rounded operations (+ - * / sqrt) and our own exp() are used, so a link's result does not
 * depend on its place in the pack.
 */
namespace dem
{
  namespace stdx = std::experimental;

  constexpr int pack_size = 8;

  using Pack     = stdx::simd<double, stdx::simd_abi::deduce_t<double, pack_size>>;
  using PackMask = Pack::mask_type;

  BRECCIA_KERNEL Pack load(const double *from) { return Pack(from, stdx::vector_aligned); }
  BRECCIA_KERNEL void store(const Pack &values, double *to) { values.copy_to(to, stdx::vector_aligned); }

  /** Four doubles: a record with room for one vector. */
  constexpr int half_record_size = pack_size / 2;
  using HalfPack                 = stdx::simd<double, stdx::simd_abi::deduce_t<double, half_record_size>>;

  BRECCIA_KERNEL HalfPack load_half(const double *from) { return HalfPack(from, stdx::vector_aligned); }
  BRECCIA_KERNEL void     store_low_half(const Pack &values, double *to)
  {
    stdx::split<HalfPack>(values)[0].copy_to(to, stdx::vector_aligned);
  }

  BRECCIA_KERNEL double select(const bool mask, const double yes, const double no) { return mask ? yes : no; }
  BRECCIA_KERNEL Pack   select(const PackMask &mask, const Pack &yes, const Pack &no)
  {
    Pack result               = no;
    stdx::where(mask, result) = yes;
    return result;
  }

  /** What a comparison of two T gives: bool, or one bit per lane. */
  template <typename T>
  using Comparison = decltype(std::declval<T>() > std::declval<T>());

  BRECCIA_KERNEL bool any(const bool mask) { return mask; }
  BRECCIA_KERNEL bool any(const PackMask &mask) { return stdx::any_of(mask); }

  BRECCIA_KERNEL double maximum(const double a, const double b) { return a > b ? a : b; }
  BRECCIA_KERNEL Pack   maximum(const Pack &a, const Pack &b) { return stdx::max(a, b); }

  BRECCIA_KERNEL double minimum(const double a, const double b) { return a < b ? a : b; }
  BRECCIA_KERNEL Pack   minimum(const Pack &a, const Pack &b) { return stdx::min(a, b); }

  BRECCIA_KERNEL double square_root(const double a) { return std::sqrt(a); }
  BRECCIA_KERNEL Pack   square_root(const Pack &a) { return stdx::sqrt(a); }

  /** Apply a function of one double to every lane. */
  template <typename Function>
  double each_lane(const double a, Function &&f)
  {
    return f(a);
  }
  template <typename Function>
  Pack each_lane(const Pack &a, Function &&f)
  {
    return Pack([&](auto lane) { return f(static_cast<double>(a[lane])); });
  }
} // namespace dem
