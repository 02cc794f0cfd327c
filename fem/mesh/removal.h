#pragma once

#include "fem/mesh/mesh.h"

#include <deal.II/base/point.h>

#include <functional>

namespace fem
{
  /**
   * The mesh without the elements all of whose corners are taken, and without the nodes that belonged to these alone. Names
   * stay; what becomes boundary is named "handshake". The rest may fall into several bodies.
   * @throws base::InputError where no element would be left, or none goes
   */
  template <int dim>
  Mesh<dim> without_elements(const Mesh<dim> &mesh, const std::function<bool(const dealii::Point<dim> &)> &is_taken);
} // namespace fem
