#pragma once

#include "dem/core/records.h"

/**
 * Half records: four doubles with room for one vector, of each link the moment that it carries. As in dem/core/records.h both variants
 * below only move data.
 */
namespace dem
{
  /** Three quantities of eight links as half records: lane j of the packs, and a zero, to record j. */
  BRECCIA_KERNEL void store_half_records(const Pack (&quantities)[3], double *record)
  {
#ifdef __AVX512F__
    if constexpr (Pack::size() == 8 && sizeof(Pack) == sizeof(__m512d))
      {
        const auto x = static_cast<__m512d>(quantities[0]), y = static_cast<__m512d>(quantities[1]),
                   z = static_cast<__m512d>(quantities[2]);
        for (int pair = 0; pair < 4; ++pair)
          {
            const long long a = 2 * pair, b = a + 1;
            const __m512d   both =
              _mm512_maskz_permutex2var_pd(0x33, x, _mm512_setr_epi64(a, 8 + a, 0, 0, b, 8 + b, 0, 0), y);
            _mm512_store_pd(record + record_size * pair,
                            _mm512_mask_permutexvar_pd(both, 0x44, _mm512_setr_epi64(0, 0, a, 0, 0, 0, b, 0), z));
          }
        return;
      }
#endif
    const Pack none(0.0);
    Pack       rows[8] = {quantities[0], quantities[1], quantities[2], none, none, none, none, none};
    transpose(rows);
    for (int j = 0; j < pack_size; ++j)
      store_low_half(rows[j], record + half_record_size * j);
  }

  /** What a record has last, in the place of the rotation about z: lane 5; zero elsewhere. */
  BRECCIA_KERNEL Pack last_at_rotations(const Pack &record)
  {
#ifdef __AVX512F__
    if constexpr (Pack::size() == 8 && sizeof(Pack) == sizeof(__m512d))
      return Pack(_mm512_maskz_permutexvar_pd(0x20, _mm512_set1_epi64(7), static_cast<__m512d>(record)));
#endif
    const double last = record[7];
    return Pack([&](auto lane) { return lane == 5 ? last : 0.0; });
  }

  /** A half record at the place of the rotations of a record: lanes 3 to 5; zero elsewhere. */
  BRECCIA_KERNEL Pack at_rotations(const HalfPack &half)
  {
#ifdef __AVX512F__
    if constexpr (Pack::size() == 8 && sizeof(Pack) == sizeof(__m512d))
      return Pack(_mm512_maskz_permutexvar_pd(0x38, _mm512_setr_epi64(0, 0, 0, 0, 1, 2, 0, 0),
                                              _mm512_castpd256_pd512(static_cast<__m256d>(half))));
#endif
    return Pack([&](auto lane) { return lane >= 3 && lane < 6 ? half[lane >= 3 && lane < 6 ? lane - 3 : 0] : 0.0; });
  }
} // namespace dem
