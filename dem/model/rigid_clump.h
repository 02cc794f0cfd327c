#pragma once

#include <Eigen/Core>

#include <array>
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
    Eigen::Vector3d travelled;        ///< by its centre since the start [m]
    double          mass;             ///< [kg]
    std::size_t     pebbles;          ///< how many

    /** Of translation and rotation, half a step back [J]. */
    double kinetic_energy() const { return 0.5 * (mass * velocity.squaredNorm() + spin.dot(angular_momentum)); }
  };

  /** How a particle is to move at the start; of a component that is not given one that is alone rests, and a pebble follows its body. */
  struct PrescribedVelocity
  {
    std::size_t         particle = 0;                                                       ///< by packing number
    Eigen::Vector3d     velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero(); ///< [m/s, rad/s]
    std::array<bool, 6> given = {}; ///< along x, y, z and about them
  };
} // namespace dem
