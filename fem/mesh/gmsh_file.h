#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace fem
{
  /// Elements of first order, by the number that Gmsh gives to their type.
  enum class GmshShape
  {
    line          = 1,
    triangle      = 2,
    quadrilateral = 3,
    tetrahedron   = 4,
    hexahedron    = 5,
    prism         = 6,
    pyramid       = 7,
    point         = 15
  };

  int dimension_of(GmshShape shape);

  unsigned int n_nodes_of(GmshShape shape);

  struct GmshElement
  {
    std::int64_t                number; ///< as in the file
    GmshShape                   shape;
    int                         group; ///< number of its physical group; 0: none
    std::array<unsigned int, 8> nodes; ///< places in `points`
  };

  /// What a Gmsh file says, word by word; whether its elements make a body is another question.
  struct GmshFile
  {
    std::vector<std::array<double, 3>>        points;       ///< [m]
    std::vector<std::int64_t>                 node_numbers; ///< of the points, as in the file
    std::vector<GmshElement>                  elements;     ///< of the model's dimension and of one less
    std::map<int, std::map<int, std::string>> groups;       ///< dimension -> number of the physical group -> name
  };

  /**
   * Reads a Gmsh file of format 2 or 4.1, text, with elements of first order.
   *
   * @param dimension of the model: elements of lower dimension than its sides are left out.
   * @throws base::InputError naming file and line, what was found there and what would be right.
   */
  GmshFile read_gmsh_file(const std::string &file, int dimension);
}
