#pragma once

#include <deal.II/grid/tria.h>

namespace fem
{
  /// @throws std::invalid_argument naming the first inverted or flat element and its place, or the number of unconnected parts
  ///         and a point of the smallest.
  template <int dim>
  void refuse_bad_mesh(const dealii::Triangulation<dim> &mesh);
}
