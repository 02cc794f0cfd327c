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
} // namespace dem
