#pragma once

#include "dem/core/simd.h"

#include <cstdint>

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace dem
{
  /**
 * Particles and link forces are kept as records of eight doubles, one cache line each: a link then touches as few lines as
 * possible, and a particle adds up its links with one vector instruction each. Between records (one per row) and packs (one
 * quantity of eight links) stands an 8 x 8 transpose, which is pure data movement: both variants below give the same bits.
 */
  constexpr int record_size = 8;

  /** Quantity i of record j to lane j of packs[i]. */
  BRECCIA_KERNEL void transpose(Pack (&packs)[8])
  {
#ifdef __AVX512F__
    if constexpr (Pack::size() == 8 && sizeof(Pack) == sizeof(__m512d))
      {
        __m512d r[8], t[8], u[8];
        for (int i = 0; i < 8; ++i)
          r[i] = static_cast<__m512d>(packs[i]);
        for (int i = 0; i < 8; i += 2)
          {
            t[i]     = _mm512_unpacklo_pd(r[i], r[i + 1]);
            t[i + 1] = _mm512_unpackhi_pd(r[i], r[i + 1]);
          }
        for (int half = 0; half < 8; half += 4)
          for (int i = 0; i < 2; ++i)
            {
              u[half + i]     = _mm512_shuffle_f64x2(t[half + i], t[half + i + 2], 0x88); // 128-bit lanes 0, 2 of both
              u[half + i + 2] = _mm512_shuffle_f64x2(t[half + i], t[half + i + 2], 0xdd); // lanes 1, 3 of both
            }
        // u[i] holds, of records 0..3, quantities {i, i + 4} for i < 2 and {i, i + 4} shifted by two for i >= 2
        for (int i = 0; i < 4; ++i)
          {
            packs[i]     = Pack(_mm512_shuffle_f64x2(u[i], u[i + 4], 0x88));
            packs[i + 4] = Pack(_mm512_shuffle_f64x2(u[i], u[i + 4], 0xdd));
          }
        return;
      }
#endif
    alignas(64) double rows[8][8];
    for (int i = 0; i < 8; ++i)
      store(packs[i], rows[i]);
    for (int i = 0; i < 8; ++i)
      packs[i] = Pack([&](auto lane) { return rows[lane][i]; });
  }
} // namespace dem
