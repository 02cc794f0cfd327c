#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dem
{
  /** Particles that keep their distances, and move as one rigid body of its own mass: its pebbles. */
  struct RigidClump
  {
    std::vector<std::size_t> particles;                        ///< by packing number
    double                   mass   = 0;                       ///< [kg], > 0
    Eigen::Vector3d          centre = Eigen::Vector3d::Zero(); ///< of mass, at the start [m]
    Eigen::Matrix3d          inertia =
      Eigen::Matrix3d::Zero(); ///< about the centre, at the start [kg m^2]; in the plane z alone counts
  };

  /** How a clump moves. */
  struct ClumpState
  {
    Eigen::Vector3d position;         ///< of its centre [m]
    Eigen::Vector3d velocity, spin;   ///< half a step back [m/s, rad/s]
    Eigen::Vector3d angular_momentum; ///< about its centre, likewise [kg m^2/s]
    Eigen::Matrix3d turned;           ///< since the start
  };
} // namespace dem
