#pragma once

#include "fem/mesh/mesh.h"
#include "fem/mesh/shape_sizes.h"

namespace fem
{
  /// Options of every built-in shape besides its measures.
  struct ShapeOptions
  {
    ElementFamily family       = ElementFamily::hypercube;
    unsigned int  refinements  = 0; ///< each halves every element
    MPI_Comm      communicator = MPI_COMM_WORLD;
  };

  /// @throws base::InputError on measures that do not fit together. The only material is named solid.
  template <int dim>
  Mesh<dim> make_shape(const BoxShape &shape, const ShapeOptions &options);
  /// With the materials of its bodies. @throws also for bodies that overlap
  template <int dim>
  Mesh<dim> make_shape(const BodiesShape &shape, const ShapeOptions &options);
  template <int dim>
  Mesh<dim> make_shape(const NotchedBeamShape &shape, const ShapeOptions &options);
  template <int dim>
  Mesh<dim> make_shape(const PlateWithHoleShape &shape, const ShapeOptions &options);
  template <int dim>
  Mesh<dim> make_shape(const CylinderShape &shape, const ShapeOptions &options);
}
