#pragma once

#include "dem/ranks/shares.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** Of a ghost at every step: place, tau theta and what it moved and turned by, three numbers each. */
  constexpr std::size_t bytes_per_ghost = 12 * sizeof(double);

  /** What joins ranks; the values are those of a cluster's network of 100 Gbit/s. */
  struct Network
  {
    double latency   = 2e-6; ///< of a message [s]
    double bandwidth = 1e10; ///< of a rank, either way [B/s]
  };

  /** How long a rank's ghosts take to arrive: its messages one after the other, its bytes both ways at once [s]. */
  double seconds_of_exchange(const RankShare &share, const Network &network);

  /**
   * Seconds of a step over ranks (doc/theory/ranks.md, 4): of the slowest, whose exchange is hidden behind the bricks that need no ghost, and of
   * the largest displacement found among all. @param seconds_per_work of an update of a link, of one rank
   */
  double seconds_of_step(const std::vector<RankShare> &shares, double seconds_per_work, const Network &network);

  /** Seconds of the step on one rank, over those on all together [-]. */
  double parallel_efficiency(const std::vector<RankShare> &shares, double seconds_per_work, const Network &network);
} // namespace dem
