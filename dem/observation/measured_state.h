#pragma once

#include "dem/measures/coordination.h"
#include "dem/measures/fabric.h"
#include "dem/measures/link_directions.h"
#include "dem/observation/discrete_state.h"

#include <optional>

namespace dem
{
  /** Part of a state, by where particles and the contact points of links are now [m]. */
  struct MeasuredBox
  {
    Eigen::Vector3d low, high;

    bool holds(const Eigen::Vector3d &place) const
    {
      return (place.array() >= low.array()).all() && (place.array() <= high.array()).all();
    }
  };

  /** Means over a saved state, or over a part of it (doc/theory/stress-and-fabric.md). */
  struct MeasuredState
  {
    std::size_t     particles = 0, held = 0;
    double          volume      = 0;                       ///< their shares, voids included [m^3]
    Eigen::Matrix3d stress      = Eigen::Matrix3d::Zero(); ///< mean over that volume, tension positive [Pa]
    std::size_t     links       = 0;                       ///< cohesive ones that were made
    std::size_t     gone        = 0;                       ///< of them without strength
    double          mean_damage = 0;                       ///< lost part of their strength [-]
    Eigen::Matrix3d damage      = Eigen::Matrix3d::Zero(); ///< tensor of all of them, for directions taken as even [-]
    Coordination    coordination; ///< of the links that still hold, over the particles measured

    std::optional<double>              solid;          ///< part of the volume that is filled by spheres [-]; in space
    std::optional<Eigen::Matrix3d>     fitted_damage;  ///< over the directions there are, where these determine it [-]
    std::optional<Fabric>              fabric_made;    ///< of all links that were made; nothing: there are none
    std::optional<Fabric>              fabric_holding; ///< of those that still hold
    std::optional<DirectionStatistics> directions;     ///< of the same, of a state in space
  };

  /** @throws base::InputError where no particle is in the box */
  MeasuredState measured(const DiscreteState &state, const std::optional<MeasuredBox> &box = std::nullopt);
} // namespace dem
