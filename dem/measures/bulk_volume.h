#pragma once

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /**
   * Volume, voids included, per solid volume of particles that form a body: the reciprocal of the packing fraction inside.
   *
   * Measured around particles that lie deep inside (what a ball of 2.5 mean diameters holds is centred on it), with a Gaussian
   * weight so narrow that the surface does not count and so smooth that a lattice is measured exactly. A sparse surface, the
   * body's shape and its orientation do not matter. Where no particle is deep (small or thin bodies): the box around all
   * particles over their solid volume.
   *
   * @param solid volume of each particle [m^3], in two dimensions area times thickness
   * @param thickness of discs [m]; in space not used
   */
  double bulk_over_solid(const std::vector<Eigen::Vector3d> &centre,
                         const std::vector<double>          &radius,
                         const std::vector<double>          &solid,
                         int                                 dimension,
                         double                              thickness);
} // namespace dem
