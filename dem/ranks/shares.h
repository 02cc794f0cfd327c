#pragma once

#include "dem/ranks/bricks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  /** A rank that another exchanges particles with at every step. */
  struct RankNeighbour
  {
    std::size_t rank     = 0;
    std::size_t received = 0; ///< particles that are ghosts here
    std::size_t sent     = 0; ///< particles that are ghosts there
  };

  /**
   * What a rank has of a specimen (doc/theory/ranks.md, 3): a range of bricks, and with it the particles in them and the links whose first end is
   * one of them. A cut link, whose ends belong to different ranks, is computed by both: the rank of its second end has a copy. Ends that belong to
   * others are ghosts.
   */
  struct RankShare
  {
    std::size_t                first_brick = 0, end_brick = 0;
    std::size_t                first_particle = 0, end_particle = 0;
    std::size_t                owned = 0;  ///< links
    std::vector<std::int32_t>  copied;     ///< links, ascending
    std::vector<std::int32_t>  ghosts;     ///< particles, ascending
    std::vector<RankNeighbour> neighbours; ///< ascending by rank
    std::int64_t               work = 0;   ///< updates of a link: of particles, owned links and copies

    std::size_t particles() const { return end_particle - first_particle; }
    std::size_t received() const { return ghosts.size(); }
    std::size_t sent() const;         ///< particles, one that goes to several ranks for each of them
    std::size_t copied_lines() const; ///< of packs that have a copied link, which are updated as a whole
  };

  /**
   * Share out a specimen by work, copies included: ranges even in owned work are evened again with the copies that they lead to, as long as that
   * makes the largest share smaller. The same for the same specimen, whoever computes it.
   *
   * @throws std::invalid_argument for no rank, or a link whose end is no particle
   */
  std::vector<RankShare> share_out(std::size_t particles, const LinkEnds &links, std::size_t ranks);
} // namespace dem
