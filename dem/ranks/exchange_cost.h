#pragma once

#include "dem/ranks/shares.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** Of a ghost at every step: place, tau theta and what it moved and turned by, three numbers each. */
  constexpr std::size_t bytes_per_ghost = 12 * sizeof(double);

  /** Of a brick at every step to all ranks: the sums over its particles. */
  constexpr std::size_t bytes_per_brick = sizeof(ParticleBlockAccount);

  /** How often all ranks must hear from all others in a step: which links broke, these sums, whether the run shall stop. */
  constexpr double meetings_per_step = 3;

  /** What joins ranks; the values are those of a cluster's network of 100 Gbit/s. */
  struct Network
  {
    double latency   = 2e-6; ///< of a message [s]
    double bandwidth = 1e10; ///< of a rank, either way [B/s]
  };

  /** How long a rank's ghosts take to arrive: its messages one after the other, its bytes both ways at once [s]. */
  double seconds_of_exchange(const RankShare &share, const Network &network);

  /**
   * Seconds of a step over ranks (doc/theory/ranks.md, 4): of the slowest with its exchange, and of what all hear from all. @param seconds_per_work of an update of a link, of one rank
   */
  double seconds_of_step(const std::vector<RankShare> &shares, double seconds_per_work, const Network &network);

  /** Seconds of the step on one rank, over those on all together [-]. */
  double parallel_efficiency(const std::vector<RankShare> &shares, double seconds_per_work, const Network &network);
} // namespace dem
