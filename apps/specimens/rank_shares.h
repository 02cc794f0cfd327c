#pragma once

#include "dem/ranks/exchange_cost.h"
#include "dem/specimen/observation.h"

#include <cstddef>
#include <string>
#include <vector>

namespace apps
{
  /** What shares come to, over all ranks. */
  struct RankTotals
  {
    std::size_t owned = 0, copied = 0, ghosts = 0;                    ///< links, links, particles
    std::size_t copied_lines = 0;                                     ///< links updated twice: all of packs with a copy
    std::size_t least_bricks = 0, most_bricks = 0;                    ///< of a rank
    std::size_t most_ghosts = 0, most_neighbours = 0, most_bytes = 0; ///< of a rank; bytes it sends at every step
    double      work         = 0;                                     ///< of all, copies included: updates of a link
    double      largest_work = 0;                                     ///< of a rank

    double copies() const { return of_owned(copied); } ///< over links
    double twice() const { return of_owned(copied_lines); }

  private:
    double of_owned(const std::size_t links) const
    {
      return owned > 0 ? static_cast<double>(links) / static_cast<double>(owned) : 0.0;
    }
  };

  RankTotals totals_of(const std::vector<dem::RankShare> &shares);

  /**
   * Lines of a forecast: shares of ranks, ghosts, bytes and the efficiency that the model of doc/theory/ranks.md, 4 expects.
   * @param seconds_per_step of the specimen in this process @throws base::InputError for a specimen that cannot be shared out
   */
  std::string rank_lines(const dem::ObservedSpecimen &body, std::size_t ranks, double seconds_per_step);
} // namespace apps
