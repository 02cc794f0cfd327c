#pragma once

#include "dem/neighbours/cell_list.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace dem
{
  class Ranks;

  /**
   * How one of several ranks takes part in a search for neighbours (doc/theory/ranks.md, 3): it looks for pairs of which the first is one of
   * its own particles, and all come to have those of all, in the order of one. Alone, all particles are its own.
   */
  class SharedSearch
  {
  public:
    /** As Ranks::gather(). */
    using Gather = std::function<void(void *array, const std::vector<std::size_t> &begin)>;

    SharedSearch() = default;
    /** @param rank this one @param begin particle of each rank, and behind the last @param gather called by all ranks in the same order */
    SharedSearch(std::size_t rank, std::vector<std::int32_t> begin, Gather gather);

    /** Whose pairs are wanted here, those with a lower first among them. */
    PairsOf own() const;
    /** Leave out pairs that another rank is to find. */
    void drop_others(std::vector<NeighbourPair> &pairs) const;
    /** Of what each rank has found. */
    double largest(double own) const;
    /** One rank's after the other's. */
    std::vector<NeighbourPair> of_all(std::vector<NeighbourPair> pairs) const;

  private:
    /** What each rank has of something, of whole doubles or integers as wide. @pre there are others */
    template <typename Record>
    std::vector<Record> of_each(Record own) const;

    std::size_t               self = 0;
    std::vector<std::int32_t> particle_begin;
    Gather                    gather; ///< none: alone
  };

  /** Ranks that have not shared out the particles yet: bricks by their number. @param ranks null: alone; otherwise they outlive the search */
  SharedSearch search_by(Ranks *ranks, std::size_t particles);
} // namespace dem
