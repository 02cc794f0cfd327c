#pragma once

#include "dem/specimen/results.h"

#include <Eigen/Core>

#include <vector>

namespace dem
{
  class ObservedSpecimen;

  /**
   * How a group of particles moves as a whole. A rigid clump all of whose pebbles are of it counts as the body that it is, with its own mass,
   * centre and inertia; of another one each pebble counts with its part of the mass.
   */
  struct GroupMotion
  {
    double          mass           = 0;                       ///< [kg]
    Eigen::Vector3d position       = Eigen::Vector3d::Zero(); ///< of the centre of mass [m]
    Eigen::Vector3d travelled      = Eigen::Vector3d::Zero(); ///< by it since the start [m]
    Eigen::Vector3d velocity       = Eigen::Vector3d::Zero(); ///< of it, half a step back [m/s]
    Eigen::Vector3d spin           = Eigen::Vector3d::Zero(); ///< mean of particles and bodies by mass [rad/s]
    double          kinetic_energy = 0;                       ///< of translation and rotation, half a step back [J]
  };

  /** @param particles of the specimen, as it is now @param group packing numbers, each once; not empty */
  GroupMotion motion_of(const ObservedSpecimen         &specimen,
                        const ParticleKinematics       &particles,
                        const std::vector<std::size_t> &group);
} // namespace dem
