#pragma once

#include "coupling/volume/parameters.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace coupling
{
  /**
   * Bonded particles that lie in an overlap, by number.
   * @param in_solid whether a place lies in an element
   * @throws base::InputError where there are none; for a particle in the overlap and not in the solid, in the solid beyond the overlap,
   * or, unless multipliers keep both together, in an element that reaches into the particles' own region; for one that another handshake
   * has as well
   */
  std::vector<std::size_t> overlapping_particles(const std::vector<Eigen::Vector3d>                 &places,
                                                 const VolumeCouplingParameters                     &coupling,
                                                 const std::function<bool(const Eigen::Vector3d &)> &in_solid);
} // namespace coupling
