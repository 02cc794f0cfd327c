#pragma once

#include "fem/mesh/shape_sizes.h"

#include <deal.II/grid/tria.h>

namespace fem
{
  /**
   * A ball, in the plane a disc, of blocks and quadrilaterals: a cube within, and around it six parts that end on the surface. Towards the
   * finest place boxes lie in boxes, each of elements smaller than the one around it, and conforming: elsewhere they are as in an
   * even mesh. Nodes on the surface lie off the sphere by so much that faces are as far outside as inside, and the volume is the ball's.
   * @pre its measures have been checked
   */
  template <int dim>
  void make_ball(const NamedBall &ball, dealii::Triangulation<dim> &mesh);
}
