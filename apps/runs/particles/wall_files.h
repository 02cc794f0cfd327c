#pragma once

#include "dem/facets/facet_mesh.h"

#include <string>

namespace apps
{
  /**
   * Triangles of a file: STL (text or binary), or Gmsh (.msh) with triangles and quadrilaterals, which are split.
   * Triangles without area are left out, which is said on the standard error.
   * @param scale by which its lengths are multiplied; 0: they are metres, and so many of them that millimetres are more likely are refused
   * @throws base::InputError naming the file and the place
   */
  dem::FacetMesh read_wall(const std::string &file, double scale);
} // namespace apps
