#pragma once

#include "dem/specimen/specimen.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

/**
 * A specimen goes through the same states to the last bit with 1 to 4 threads, and when it is begun again from the state after some
 * steps.
 *
 * @param made makes it @param first steps until it is kept @param further steps after that @param broken at least so many links break on the way
 */
template <typename Make>
void check_same_bits(const Make &made, const int first, const int further, const std::size_t broken)
{
  omp_set_num_threads(1);
  dem::Specimen one = made();
  one.advance(first);
  const MemoryState half = MemoryState::of(one);
  one.advance(further);
  REQUIRE(one.counts().broken >= broken);
  const MemoryState end = MemoryState::of(one);
  for (const int threads : {2, 3, 4})
    {
      omp_set_num_threads(threads);
      dem::Specimen several = made();
      several.advance(first + further);
      CHECK(MemoryState::of(several) == end);
    }
  omp_set_num_threads(1);
  dem::Specimen resumed = made();
  half.restore(resumed);
  resumed.advance(further);
  CHECK(MemoryState::of(resumed) == end);
}
