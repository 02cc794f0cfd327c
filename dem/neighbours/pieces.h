#pragma once

#include "dem/neighbours/cell_list.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** The connected pieces of a specimen: within one, every particle is reached from every other over links. */
  struct Pieces
  {
    std::vector<std::size_t>
      piece;                       ///< of each particle its number; the largest is 0, of equal ones the one found first
    std::vector<std::size_t> size; ///< of each piece, falling

    std::size_t strays() const; ///< particles without any link
  };

  /** Graph search over the links. @param links between particles below the given number */
  Pieces find_pieces(std::size_t particles, const std::vector<NeighbourPair> &links);
} // namespace dem
