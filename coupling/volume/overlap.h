#pragma once

#include <Eigen/Core>

#include <functional>

namespace coupling
{
  /**
   * Where particles and a solid fill the same space (doc/theory/volume-coupling.md, 1): a layer around the region that is the particles'
   * alone. Across it the share of the solid grows evenly from nothing to all, and that of the particles is the rest.
   */
  struct Overlap
  {
    std::function<double(const Eigen::Vector3d &)> distance; ///< from the particles' own region, negative in it [m]
    double width = 0;    ///< of the layer [m]; 0: a surface, for constrained particles
    double least = 1e-3; ///< share that either side keeps in the layer [-]

    bool   contains(const Eigen::Vector3d &place) const; ///< whether both are there
    double of_solid(const Eigen::Vector3d &place) const;
    double of_particles(const Eigen::Vector3d &place) const;
  };

  /** From a box, whose edges may be infinite [m]: the longest of the distances along the axes. */
  std::function<double(const Eigen::Vector3d &)> distance_from_box(const Eigen::Vector3d &low,
                                                                   const Eigen::Vector3d &high);
  /** From a ball; in the plane from a disc [m]. */
  std::function<double(const Eigen::Vector3d &)> distance_from_ball(const Eigen::Vector3d &centre, double radius);
} // namespace coupling
