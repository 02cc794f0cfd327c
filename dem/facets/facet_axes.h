#pragma once

#include "dem/facets/facet_mesh.h"

#include <Eigen/Geometry>

namespace dem
{
  /** Axes that turn with a facet, as columns: along its first side, across that in it, and its normal; of a segment z is the last. */
  inline Eigen::Matrix3d
  facet_axes(const FacetMesh &mesh, const std::vector<Eigen::Vector3d> &place, const std::int32_t facet)
  {
    const auto &number = mesh.facet[static_cast<std::size_t>(facet)];
    const auto  corner = [&](const std::size_t c) -> const Eigen::Vector3d  &{
      return place[static_cast<std::size_t>(number[c])];
    };
    Eigen::Matrix3d axes;
    axes.col(0) = (corner(1) - corner(0)).normalized();
    axes.col(2) = mesh.corners == 3 ?
                    Eigen::Vector3d(axes.col(0).cross(Eigen::Vector3d(corner(2) - corner(0))).normalized()) :
                    Eigen::Vector3d(Eigen::Vector3d::UnitZ());
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }
} // namespace dem
