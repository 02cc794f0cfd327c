#pragma once

#include "fem/mesh/mesh.h"

namespace fem
{
  /**
   * Reads a Gmsh file (format 2.2 or 4.1, text); physical groups of dimension dim - 1 become boundary names, those of
   * dimension dim material names.
   *
   * Every rank reads the file. @throws std::invalid_argument naming the file and what is wrong with it: missing, no element of
   * this dimension, elements without a physical group, an unnamed group, mixed shapes, an inverted element, unconnected parts.
   */
  template <int dim>
  Mesh<dim> read_gmsh(const std::string &file, MPI_Comm communicator = MPI_COMM_WORLD);
}
