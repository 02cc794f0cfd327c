#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fem
{
  /// A solid as a viewer sees it, in plain numbers: places and displacements of nodes, elements, and fields.
  struct SolidSnapshot
  {
    struct Field
    {
      std::string        name, unit; ///< unit: empty if it is not known here
      int                components; ///< 1, 3 (vector) or 6 (symmetric tensor xx yy zz xy yz xz; tensor shears)
      std::vector<float> values;     ///< row by row
    };

    std::vector<float>        place;             ///< x y z of each node, undeformed [m]
    int                       element_type  = 0; ///< number in VTK's file format, e.g. 9: quadrilateral, 12: hexahedron
    int                       element_nodes = 0; ///< per element
    std::vector<std::int64_t> elements;          ///< their nodes, in VTK's order
    std::vector<Field>        at_nodes, of_elements;

    std::size_t nodes() const { return place.size() / 3; }
    std::size_t size() const
    {
      return element_nodes > 0 ? elements.size() / static_cast<std::size_t>(element_nodes) : 0;
    }
  };
}
