#pragma once

#include "dem/kernels/particle_pass.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  /** Particles of a brick, in their order along the space-filling curve: the smallest part that ranks share out (doc/theory/ranks.md, 1). */
  constexpr std::size_t particles_per_brick = particles_per_block;

  /** Ends of links as places in the order of Particles. */
  struct LinkEnds
  {
    std::vector<std::int32_t> first, second;

    std::size_t size() const { return first.size(); }
  };

  inline std::size_t brick_of(const std::int32_t particle)
  {
    return static_cast<std::size_t>(particle) / particles_per_brick;
  }

  /** What the pass of a particle costs, in updates of a link (doc/theory/ranks.md, 3). */
  constexpr std::int64_t updates_per_particle = 3;

  /** Work of each brick in updates of a link: its particles, and the links that it owns, which are those whose first end it has. */
  std::vector<std::int64_t> work_of_bricks(std::size_t particles, const LinkEnds &links);

  /**
   * Contiguous ranges of about equal work: each boundary lies where the work before it is nearest to its even part (doc/theory/ranks.md, 3), so
   * that no range is off the mean by more than one brick's work.
   *
   * @param work of each brick, >= 0 @param ranks >= 1; where there are more than bricks, some ranges are empty
   * @return the first brick of each range, and behind the last; ranks + 1 numbers @throws std::invalid_argument for no rank
   */
  std::vector<std::size_t> even_ranges(const std::vector<std::int64_t> &work, std::size_t ranks);

  /** Particles of ranks that have as many bricks each, as nothing is known of their work: the first of each, and behind the last. */
  std::vector<std::size_t> ranges_by_number(std::size_t particles, std::size_t ranks);
} // namespace dem
