#pragma once

#include <Eigen/Core>
#include <deal.II/base/point.h>

namespace fem
{
  /// A point of the mesh [m]; one of the plane has z = 0.
  template <int dim>
  Eigen::Vector3d in_space(const dealii::Point<dim> &place)
  {
    return {place[0], place[1], dim == 3 ? place[dim - 1] : 0.0};
  }
} // namespace fem
