#pragma once

#include "dem/core/simd.h"

#include <cstdint>

namespace dem
{
  /**
 * Particles and link forces are kept as records of eight doubles, one cache line each: a link then touches as few lines as
 * possible, and a particle adds up its links with one vector instruction each. Between records (one per row) and packs (one
 * quantity of eight links) stands an 8 x 8 transpose, which is pure data movement: all variants below give the same bits.
 */
  constexpr int record_size = 8;

  /** Four rows of four numbers: number i of row j to lane j of rows[i]. */
  BRECCIA_KERNEL void transpose(HalfPack (&rows)[4])
  {
#if BRECCIA_VECTOR == 16
    const HalfPack r[4] = {rows[0], rows[1], rows[2], rows[3]};
    rows[0]             = {{__builtin_shufflevector(r[0].low.v, r[1].low.v, 0, 2)},
                           {__builtin_shufflevector(r[2].low.v, r[3].low.v, 0, 2)}};
    rows[1]             = {{__builtin_shufflevector(r[0].low.v, r[1].low.v, 1, 3)},
                           {__builtin_shufflevector(r[2].low.v, r[3].low.v, 1, 3)}};
    rows[2]             = {{__builtin_shufflevector(r[0].high.v, r[1].high.v, 0, 2)},
                           {__builtin_shufflevector(r[2].high.v, r[3].high.v, 0, 2)}};
    rows[3]             = {{__builtin_shufflevector(r[0].high.v, r[1].high.v, 1, 3)},
                           {__builtin_shufflevector(r[2].high.v, r[3].high.v, 1, 3)}};
#else
    const auto even_01 = __builtin_shufflevector(rows[0].v, rows[1].v, 0, 4, 2, 6),
               odd_01  = __builtin_shufflevector(rows[0].v, rows[1].v, 1, 5, 3, 7),
               even_23 = __builtin_shufflevector(rows[2].v, rows[3].v, 0, 4, 2, 6),
               odd_23  = __builtin_shufflevector(rows[2].v, rows[3].v, 1, 5, 3, 7);
    rows[0].v          = __builtin_shufflevector(even_01, even_23, 0, 1, 4, 5);
    rows[1].v          = __builtin_shufflevector(odd_01, odd_23, 0, 1, 4, 5);
    rows[2].v          = __builtin_shufflevector(even_01, even_23, 2, 3, 6, 7);
    rows[3].v          = __builtin_shufflevector(odd_01, odd_23, 2, 3, 6, 7);
#endif
  }

  /** Quantity i of record j to lane j of packs[i]. */
  BRECCIA_KERNEL void transpose(Pack (&packs)[8])
  {
#if BRECCIA_VECTOR == 64
    __m512d t[8], u[8];
    for (int i = 0; i < 8; i += 2)
      {
        t[i]     = _mm512_unpacklo_pd(packs[i].v, packs[i + 1].v);
        t[i + 1] = _mm512_unpackhi_pd(packs[i].v, packs[i + 1].v);
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
#else
    // By quarters; the two off the diagonal change places.
    HalfPack first_low[4]  = {packs[0].low, packs[1].low, packs[2].low, packs[3].low},
             first_high[4] = {packs[0].high, packs[1].high, packs[2].high, packs[3].high},
             last_low[4]   = {packs[4].low, packs[5].low, packs[6].low, packs[7].low},
             last_high[4]  = {packs[4].high, packs[5].high, packs[6].high, packs[7].high};
    transpose(first_low);
    transpose(first_high);
    transpose(last_low);
    transpose(last_high);
    for (int i = 0; i < 4; ++i)
      {
        packs[i]     = {first_low[i], last_low[i]};
        packs[i + 4] = {first_high[i], last_high[i]};
      }
#endif
  }
} // namespace dem
