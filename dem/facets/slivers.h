#pragma once

#include "dem/facets/facet_mesh.h"

#include <cstddef>

namespace dem
{
  /** Takes out the triangles that have no area, as files of other programs hold a few. They bound nothing: what is left is the same surface. @return how many */
  std::size_t drop_slivers(FacetMesh &mesh);
} // namespace dem
