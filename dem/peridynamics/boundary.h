#pragma once

#include "dem/peridynamics/grid.h"

#include <string>
#include <vector>

namespace dem::peridynamics
{
  /** A point of the boundary at which a traction acts. */
  struct BoundaryPoint
  {
    Eigen::Vector3d place  = Eigen::Vector3d::Zero(); ///< [m]
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< outward
    double          area   = 0;                       ///< [m^2]
    std::size_t     outer  = 0; ///< place of the outermost node beside it, or of the node that it is
    std::size_t     inner  = 0; ///< of the next one inwards; the same where there is none
  };

  /** Names of the sides that a body of so many dimensions has: left, right (x), bottom, top (y), back, front (z). */
  std::vector<std::string> side_names(int dimension);

  /**
   * Points of a side, by its word or by its axis ("x min" for "left"), or of a hole by its name.
   *
   * Layout::boundary_nodes: the nodes of the side. Layout::cell_centred: the projections of the outermost nodes. Of a hole: points
   * evenly around it, about a spacing apart, beside their nearest nodes.
   * @throws base::InputError where there is no such side or hole, or no node is left beside it
   */
  std::vector<BoundaryPoint> boundary_points(const Grid &grid, const std::string &boundary);

  /** Places of the nodes of the outermost layer of a side. @throws base::InputError as above */
  std::vector<std::size_t> outer_nodes(const Grid &grid, const std::string &side);
} // namespace dem::peridynamics
