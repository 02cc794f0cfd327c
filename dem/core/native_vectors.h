#pragma once

#include "dem/core/inline.h"
#include "dem/core/multiply_add.h"
#include "dem/core/vector_signs.h"
#include "dem/core/vector_width.h"

#include <cmath>

/**
 * What a processor does with its own vectors of doubles and a compiler has no operator for: one overload a width, so that a width, or
 * another processor, is a block of its own. All of them round as the scalar functions of the same name.
 *
 * maximum(a, b) and minimum(a, b) are the second one where either is not a number, as a > b ? a : b.
 */
namespace dem::native
{
#if BRECCIA_VECTOR == 64
  BRECCIA_KERNEL __m512d  maximum(const __m512d a, const __m512d b) { return _mm512_max_pd(a, b); }
  BRECCIA_KERNEL __m512d  minimum(const __m512d a, const __m512d b) { return _mm512_min_pd(a, b); }
  BRECCIA_KERNEL __m512d  square_root(const __m512d a) { return _mm512_sqrt_pd(a); }
  BRECCIA_KERNEL void     stream(const __m512d a, double *to) { _mm512_stream_pd(to, a); }
  BRECCIA_KERNEL __mmask8 greater(const __m512d a, const __m512d b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
  BRECCIA_KERNEL __mmask8 not_less(const __m512d a, const __m512d b) { return _mm512_cmp_pd_mask(a, b, _CMP_GE_OQ); }
  BRECCIA_KERNEL __m512d  select(const __mmask8 m, const __m512d a, const __m512d b)
  {
    return _mm512_mask_blend_pd(m, b, a);
  }
  BRECCIA_KERNEL __m512d multiply_add(const __m512d a, const __m512d b, const __m512d c)
  {
    return _mm512_fmadd_pd(a, b, c);
  }
  BRECCIA_KERNEL __m512d multiply_subtract(const __m512d a, const __m512d b, const __m512d c)
  {
    return _mm512_fmsub_pd(a, b, c);
  }
  BRECCIA_KERNEL __m512d negative_multiply_add(const __m512d a, const __m512d b, const __m512d c)
  {
    return _mm512_fnmadd_pd(a, b, c);
  }
#endif

#if defined(__AVX__)
  BRECCIA_KERNEL __m256d maximum(const __m256d a, const __m256d b) { return _mm256_max_pd(a, b); }
  BRECCIA_KERNEL __m256d minimum(const __m256d a, const __m256d b) { return _mm256_min_pd(a, b); }
  BRECCIA_KERNEL __m256d square_root(const __m256d a) { return _mm256_sqrt_pd(a); }
  BRECCIA_KERNEL void    stream(const __m256d a, double *to) { _mm256_stream_pd(to, a); }
#endif

#if defined(__SSE2__)
  BRECCIA_KERNEL __m128d maximum(const __m128d a, const __m128d b) { return _mm_max_pd(a, b); }
  BRECCIA_KERNEL __m128d minimum(const __m128d a, const __m128d b) { return _mm_min_pd(a, b); }
  BRECCIA_KERNEL __m128d square_root(const __m128d a) { return _mm_sqrt_pd(a); }
  BRECCIA_KERNEL void    stream(const __m128d a, double *to) { _mm_stream_pd(to, a); }
#elif defined(__aarch64__)
  BRECCIA_KERNEL float64x2_t maximum(const float64x2_t a, const float64x2_t b)
  {
    return vbslq_f64(vcgtq_f64(a, b), a, b);
  }
  BRECCIA_KERNEL float64x2_t minimum(const float64x2_t a, const float64x2_t b)
  {
    return vbslq_f64(vcltq_f64(a, b), a, b);
  }
  BRECCIA_KERNEL float64x2_t square_root(const float64x2_t a) { return vsqrtq_f64(a); }
  BRECCIA_KERNEL void        stream(const float64x2_t a, double *to) { vst1q_f64(to, a); }
#endif

#if defined(__FMA__)
  BRECCIA_KERNEL __m256d multiply_add(const __m256d a, const __m256d b, const __m256d c)
  {
    return _mm256_fmadd_pd(a, b, c);
  }
  BRECCIA_KERNEL __m256d multiply_subtract(const __m256d a, const __m256d b, const __m256d c)
  {
    return _mm256_fmsub_pd(a, b, c);
  }
  BRECCIA_KERNEL __m256d negative_multiply_add(const __m256d a, const __m256d b, const __m256d c)
  {
    return _mm256_fnmadd_pd(a, b, c);
  }
  BRECCIA_KERNEL __m128d multiply_add(const __m128d a, const __m128d b, const __m128d c)
  {
    return _mm_fmadd_pd(a, b, c);
  }
  BRECCIA_KERNEL __m128d multiply_subtract(const __m128d a, const __m128d b, const __m128d c)
  {
    return _mm_fmsub_pd(a, b, c);
  }
  BRECCIA_KERNEL __m128d negative_multiply_add(const __m128d a, const __m128d b, const __m128d c)
  {
    return _mm_fnmadd_pd(a, b, c);
  }
#else
  template <typename Vector>
  BRECCIA_KERNEL Vector multiply_add(const Vector a, const Vector b, const Vector c)
  {
#if defined(__aarch64__)
    return vfmaq_f64(c, a, b);
#else
    return multiply_add_in_parts(a, b, c);
#endif
  }
  template <typename Vector>
  BRECCIA_KERNEL Vector multiply_subtract(const Vector a, const Vector b, const Vector c)
  {
    return multiply_add(a, b, -c);
  }
  template <typename Vector>
  BRECCIA_KERNEL Vector negative_multiply_add(const Vector a, const Vector b, const Vector c)
  {
    return multiply_add(-a, b, c);
  }
#endif

  /** Where a comparison gives a vector of bits. */
  template <typename Vector>
  BRECCIA_KERNEL auto greater(const Vector a, const Vector b)
  {
    return a > b;
  }
  template <typename Vector>
  BRECCIA_KERNEL auto not_less(const Vector a, const Vector b)
  {
    return a >= b;
  }
  template <typename Bits, typename Vector>
  BRECCIA_KERNEL Vector select(const Bits mask, const Vector yes, const Vector no)
  {
    return mask ? yes : no;
  }
} // namespace dem::native
