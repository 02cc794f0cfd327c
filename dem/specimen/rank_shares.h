#pragma once

#include "dem/ranks/shares.h"

#include <cstddef>
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
} // namespace dem
