#pragma once

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /**
 * Smallest convex-hull area of a body of spheres over planes across an axis between two heights [m^2].
 *
 * Spheres that a plane meets are projected on it at their full radius, so that a crop of a packing keeps the area of its box; the section
 * is the area of the convex hull of these circles, counted with its voids. Planes that meet no sphere do not count.
 *
 * @param axis 0, 1, 2: normal of the planes
 * @return infinity when no plane between the heights meets a sphere
 */
  double smallest_section(
    const std::vector<Eigen::Vector3d> &centre, const std::vector<double> &radius, int axis, double low, double high);

  /** The same for discs in the plane z = 0 of a given thickness: extent across the axis (0 or 1) times thickness. */
  double smallest_plane_section(const std::vector<Eigen::Vector3d> &centre,
                                const std::vector<double>          &radius,
                                int                                 axis,
                                double                              low,
                                double                              high,
                                double                              thickness);
} // namespace dem
