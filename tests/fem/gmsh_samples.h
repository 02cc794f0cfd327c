#pragma once

#include <string>

namespace gmsh_samples
{
  enum class Elements
  {
    triangles,
    quadrilaterals,
    tetrahedra,
    hexahedra
  };

  /// A unit square or cube of two divisions along each axis, with the groups "left" (x = 0), "right" (x = 1) and "body", as a
  /// Gmsh file of format 2.2 or 4.1.
  std::string box(Elements elements, bool format_4);
}
