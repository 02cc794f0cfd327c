#pragma once

#include "fem/mesh/gmsh_file.h"

namespace fem
{
  /// Nodes of a side of an element in rising order, filled up with the largest number.
  using SideKey = std::array<unsigned int, 4>;

  SideKey side_key(std::array<unsigned int, 4> nodes, unsigned int n_nodes);

  /// What several nodes at one place are.
  enum class DoubledNodes
  {
    refuse, ///< nodes that were not merged by mistake
    notch   ///< both faces of a notch without width
  };

  /// A connected body: what a mesh is made of, and the names of parts of its surface.
  struct GmshBody
  {
    std::vector<std::array<double, 3>> points; ///< [m], each a node of some cell
    std::vector<GmshElement>           cells;  ///< of the model's dimension, of positive volume
    std::map<SideKey, int>             groups; ///< sides on the surface -> physical group, where they have one
  };

  /**
   * Takes the cells and the named surface out of a file, after proof that they fit together.
   *
   * @throws base::InputError, naming elements and nodes by their numbers in the file: no cells; a node twice in an
   *         element; a plane model out of its plane; an inverted, flat or repeated element; elements that lie over each other or
   *         share a twisted side; nodes at one place, unless they are those of a notch; a named side that no element has or that lies inside the body.
   */
  GmshBody body_of(GmshFile &&file, int dimension, DoubledNodes doubled = DoubledNodes::refuse);
}
