#pragma once

#include "dem/facets/facet_mesh.h"

#include <array>

namespace dem
{
  /** Surfaces of common walls; lengths in metres. Discs touch the outlines of the same in the plane z = 0. */

  /** Parallelogram of two triangles with one corner and the edges from it. */
  FacetMesh plate(const Eigen::Vector3d &corner, const Eigen::Vector3d &first_edge, const Eigen::Vector3d &second_edge);
  /** One segment, the wall of discs. */
  FacetMesh segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to);

  /** Sides of a box: low x, high x, low y, high y, low z, high z. */
  using BoxSides = std::array<bool, 6>;

  /** Box of triangles along the axes. @param there sides that it has */
  FacetMesh box(const Eigen::Vector3d &low, const Eigen::Vector3d &high, const BoxSides &there);
  /** Rectangle of segments; sides along z are ignored. */
  FacetMesh rectangle(const Eigen::Vector3d &low, const Eigen::Vector3d &high, const BoxSides &there);

  /** Mantle of a cylinder: a prism whose edges lie on it. @param around how many plane sides, at least 3 @param ends closed by fans */
  FacetMesh cylinder(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double radius, int around, bool ends);
  /** Polygon whose corners lie on a circle. */
  FacetMesh circle(const Eigen::Vector3d &centre, double radius, int around);

} // namespace dem
