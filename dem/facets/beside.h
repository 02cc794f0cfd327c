#pragma once

#include "dem/facets/near_facets.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /**
   * Which particles may stand beside which on a surface: for each that has a facet near, all others whose footprint can meet its own
   * (footprint.h) while the list of near facets is good.
   */
  class Beside
  {
  public:
    /** Make the lists anew if those of near facets have been. */
    void update(const NearFacets &near, const Particles &particles);

    /** Particles beside the k-th that has a facet near, ascending. */
    const std::int32_t *begin(const std::size_t k) const { return others.data() + from[k]; }
    const std::int32_t *end(const std::size_t k) const { return others.data() + from[k + 1]; }

    /** Particles that are beside one, each perhaps several times. */
    const std::vector<std::int32_t> &particles() const { return others; }

  private:
    std::int64_t              made_at = 0; ///< search of near facets that they belong to
    std::vector<std::size_t>  from    = {0};
    std::vector<std::int32_t> others;
  };
} // namespace dem
