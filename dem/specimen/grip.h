#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace dem
{
  /** A group of particles with prescribed motion. */
  struct Grip
  {
    std::vector<std::size_t> particles;              ///< by their number in the packing, from 0
    std::array<bool, 6>      prescribed = {};        ///< x, y, z, rotation about x, y, z
    Eigen::Vector3d          velocity   = {0, 0, 0}; ///< [m/s], of the prescribed translations
    Eigen::Vector3d          spin       = {0, 0, 0}; ///< [rad/s], of the prescribed rotations
    /**
     * Normal (x, y, z: 0, 1, 2) of a face that turns freely about the particles' middle, as a platen on a spherical seat does
     * (doc/theory/laboratory-test.md, 1). All translations are prescribed then; in the mean they are as said.
     */
    std::optional<int> turning_face;
  };
} // namespace dem
