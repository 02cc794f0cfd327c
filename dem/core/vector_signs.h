#pragma once

#include "dem/core/inline.h"
#include "dem/core/vector_width.h"

/** Whether any lane of a vector has its sign bit set: how a branch reads a comparison that gave a vector of bits. */
namespace dem::native
{
#if defined(__AVX__)
  BRECCIA_KERNEL bool any_signs(const __m256d a) { return _mm256_movemask_pd(a) != 0; }
#endif
#if defined(__SSE2__)
  BRECCIA_KERNEL bool any_signs(const __m128d a) { return _mm_movemask_pd(a) != 0; }
#elif defined(__aarch64__)
  BRECCIA_KERNEL bool any_signs(const float64x2_t a) { return vmaxvq_u32(vreinterpretq_u32_f64(a)) >> 31 != 0; }
#endif
} // namespace dem::native
