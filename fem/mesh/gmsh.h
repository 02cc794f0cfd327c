#pragma once

#include "base/length_unit.h"
#include "fem/mesh/gmsh_body.h"
#include "fem/mesh/mesh.h"

namespace fem
{
  /// How a file is to be understood.
  struct GmshReading
  {
    Bodies           bodies  = Bodies::one;
    DoubledNodes     doubled = DoubledNodes::refuse;
    base::LengthUnit unit; ///< of its coordinates
  };

  /**
   * Reads a Gmsh file (format 2.2 or 4.1, text, elements of first order); physical groups of dimension dim - 1 become
   * boundary names, those of dimension dim material names.
   *
   * Nothing reaches deal.II before it is proved to fit together. Every rank reads the file.
   * @throws base::InputError naming the file, the line or the element, and what is wrong with it.
   */
  template <int dim>
  Mesh<dim> read_gmsh(const std::string &file, MPI_Comm communicator = MPI_COMM_WORLD, const GmshReading &how = {});
}
