#include "dem/facets/facets_around.h"

namespace dem
{
  FacetsAround::FacetsAround(const FacetMesh &mesh)
    : from(mesh.vertex.size() + 1, 0)
  {
    const auto corners = static_cast<std::size_t>(mesh.corners);
    for (const auto &facet : mesh.facet)
      for (std::size_t c = 0; c < corners; ++c)
        ++from[static_cast<std::size_t>(facet[c]) + 1];
    for (std::size_t v = 1; v < from.size(); ++v)
      from[v] += from[v - 1];
    std::vector<std::size_t> next(from.begin(), from.end() - 1);
    around.resize(from.back());
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t c = 0; c < corners; ++c)
        around[next[static_cast<std::size_t>(mesh.facet[f][c])]++] = static_cast<std::int32_t>(f);
  }
} // namespace dem
