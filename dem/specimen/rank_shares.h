#pragma once

#include "dem/ranks/shares.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dem
{
  struct LinkSet;
  class ObservedSpecimen;

  /** Ends of the bonds, and then of the contacts, that are not deleted. */
  LinkEnds living_ends(const LinkSet &bonds, const LinkSet &contacts);

  /**
   * How a specimen's particles, and its bonds and contacts as they are now, would be shared out among ranks. Contacts with surfaces belong to the
   * rank of their particle and count as nothing.
   */
  std::vector<RankShare> share_out(const ObservedSpecimen &specimen, std::size_t ranks);

  /**
   * Memory that particles and links of a specimen will take up in a rank while steps are taken, at least [B]: what all ranks have, and what only
   * those have who need it, of its own and of copies and ghosts. These come in whole pages, so it is somewhat more.
   */
  std::size_t least_bytes(const ObservedSpecimen &specimen, const RankShare &share);

  /** Memory that particles and links take up in a rank [B]. */
  struct RankMemory
  {
    std::int64_t in_steps = 0; ///< while steps are taken
    std::int64_t now      = 0; ///< also where something has just been read
  };

  /** Of each of the ranks that share a specimen, all of which call this; empty: there is one. */
  std::vector<RankMemory> memory_of_ranks(const ObservedSpecimen &specimen);
} // namespace dem
