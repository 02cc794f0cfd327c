#pragma once

#include "dem/facets/facet_mesh.h"

namespace dem
{
  /** Facets that share corners, by number. */
  class FacetsAround
  {
  public:
    FacetsAround() = default;
    explicit FacetsAround(const FacetMesh &mesh);

    bool given() const { return !from.empty(); }
    /** Call use(other) for every facet that has a corner of this one, once for each such corner. */
    template <typename Use>
    void each(const FacetMesh &mesh, const std::int32_t facet, const Use &use) const
    {
      for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
        {
          const auto vertex = static_cast<std::size_t>(mesh.facet[static_cast<std::size_t>(facet)][c]);
          for (std::size_t k = from[vertex]; k < from[vertex + 1]; ++k)
            use(around[k]);
        }
    }

  private:
    std::vector<std::size_t>  from;   ///< of each vertex, in the next
    std::vector<std::int32_t> around; ///< facets of each vertex
  };
} // namespace dem
