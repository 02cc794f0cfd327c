#pragma once

#include "dem/core/records.h"

/**
 * Half records: four doubles with room for one vector, of each link the moment that it carries. Only data are moved.
 */
namespace dem
{
  /** Three quantities of eight links as half records: lane j of the packs, and a zero, to record j. */
  BRECCIA_KERNEL void store_half_records(const Pack (&quantities)[3], double *record)
  {
#if BRECCIA_VECTOR == 64
    const __m512d x = quantities[0].v, y = quantities[1].v, z = quantities[2].v;
    for (int pair = 0; pair < 4; ++pair)
      {
        const long long a = 2 * pair, b = a + 1;
        const __m512d   both =
          _mm512_maskz_permutex2var_pd(0x33, x, _mm512_setr_epi64(a, 8 + a, 0, 0, b, 8 + b, 0, 0), y);
        _mm512_store_pd(record + record_size * pair,
                        _mm512_mask_permutexvar_pd(both, 0x44, _mm512_setr_epi64(0, 0, a, 0, 0, 0, b, 0), z));
      }
#else
    const HalfPack none(0.0);
    HalfPack       low[4] = {quantities[0].low, quantities[1].low, quantities[2].low, none},
             high[4]      = {quantities[0].high, quantities[1].high, quantities[2].high, none};
    transpose(low);
    transpose(high);
    for (int j = 0; j < 4; ++j)
      {
        low[j].store(record + half_record_size * j);
        high[j].store(record + half_record_size * (4 + j));
      }
#endif
  }

  /** What a record has last, in the place of the rotation about z: lane 5; zero elsewhere. */
  BRECCIA_KERNEL Pack last_at_rotations(const Pack &record)
  {
#if BRECCIA_VECTOR == 64
    return Pack(_mm512_maskz_permutexvar_pd(0x20, _mm512_set1_epi64(7), record.v));
#elif BRECCIA_VECTOR == 32
    const Pack none(0.0);
    return {none.low, {__builtin_shufflevector(none.high.v, record.high.v, 0, 7, 0, 0)}};
#else
    const Pack none(0.0);
    return {none.low, {{__builtin_shufflevector(none.high.low.v, record.high.high.v, 0, 3)}, none.high.high}};
#endif
  }

  /** A half record at the place of the rotations of a record: lanes 3 to 5; zero elsewhere. */
  BRECCIA_KERNEL Pack at_rotations(const HalfPack &half)
  {
#if BRECCIA_VECTOR == 64
    return Pack(
      _mm512_maskz_permutexvar_pd(0x38, _mm512_setr_epi64(0, 0, 0, 0, 1, 2, 0, 0), _mm512_castpd256_pd512(half.v)));
#elif BRECCIA_VECTOR == 32
    const HalfPack none(0.0);
    return {{__builtin_shufflevector(none.v, half.v, 0, 0, 0, 4)},
            {__builtin_shufflevector(none.v, half.v, 5, 6, 0, 0)}};
#else
    const auto none = HalfPack(0.0).low;
    return {{none, {__builtin_shufflevector(none.v, half.low.v, 0, 2)}},
            {{__builtin_shufflevector(half.low.v, half.high.v, 1, 2)}, none}};
#endif
  }
} // namespace dem
