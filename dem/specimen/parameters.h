#pragma once

#include "dem/model/physics.h"

#include <Eigen/Core>

#include <cstddef>

namespace dem
{
  /** How the specimen is made from a packing and integrated in time. */
  struct SpecimenParameters
  {
    Physics         physics;
    double          density           = 0; ///< of the particles, not bulk [kg/m^3], > 0
    double          interaction_ratio = 0; ///< iota: cohesive links where distance < iota (r_J + r_K), >= 1
    double          installation_gap  = 0; ///< the same where the gap is below this, besides [m], >= 0
    double          thickness         = 0; ///< [m], of the discs; two dimensions only
    std::size_t     loose          = 0; ///< how many of the packing's last particles are linked to nothing: projectiles
    double          step_factor    = 0.8;       ///< time step over the stable estimate (5.1), in (0, 1)
    double          damping        = 0;         ///< local (Cundall) damping D in [0, 1)
    Eigen::Vector3d gravity        = {0, 0, 0}; ///< acceleration of what falls [m/s^2]; not in a periodic cell
    double          emission_reach = 0; ///< of one event of acoustic emission, in mean diameters; 0: not listened to

    /** @throws base::InputError naming the entry that is outside its range */
    void check() const;
  };
} // namespace dem
