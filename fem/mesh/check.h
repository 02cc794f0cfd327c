#pragma once

#include "fem/mesh/mesh.h"

#include <deal.II/grid/tria.h>

namespace fem
{
  /// @throws base::InputError naming the first inverted or flat element and its place, or, of one body, the number of
  ///         unconnected parts and a point of the smallest.
  template <int dim>
  void refuse_bad_mesh(const dealii::Triangulation<dim> &mesh, Bodies bodies);
}
