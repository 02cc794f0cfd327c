#pragma once

#include "fem/mesh/mesh.h"

namespace fem
{
  /// What a mesh is made of: one body that hangs together, or several that need not.
  enum class Bodies
  {
    one,
    several
  };

  /// As make_mesh(), of bodies that may lie apart. @throws std::invalid_argument on an inverted element
  template <int dim>
  Mesh<dim> make_mesh_of_bodies(const BuildMesh<dim> &build, ElementFamily family, MPI_Comm communicator);

  /// As distribute_mesh(), of one body or of several.
  template <int dim>
  Mesh<dim> distribute_mesh(dealii::Triangulation<dim> &serial, MPI_Comm communicator, Bodies bodies);
}
