#pragma once

#include "fem/mesh/mesh.h"

namespace fem
{
  /// Box around a mesh, the parts of all ranks together.
  template <int dim>
  struct Extent
  {
    dealii::Point<dim> low, high;

    double diagonal() const { return low.distance(high); } ///< [m]
  };

  template <int dim>
  Extent<dim> extent_of(const Mesh<dim> &mesh);
}
