#pragma once

#include <Eigen/Core>

#include <array>
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
  };
} // namespace dem
