#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dem
{
  /** Bonds of particles with surfaces as an observer sees them: all that were made, torn ones included. */
  struct GlueOutput
  {
    std::vector<std::size_t>     particle;                    ///< numbers of the packing
    std::vector<std::int32_t>    surface;                     ///< in the order in which they were added
    std::vector<Eigen::Vector3d> anchor;                      ///< the point of the surface, where it is now [m]
    std::vector<Eigen::Vector3d> moved;                       ///< since it was glued [m]
    std::vector<std::int32_t>    torn;                        ///< 1: no longer a bond
    std::vector<double>          normal_force, shear_force;   ///< [N], as of links; of a torn one zero
    std::vector<double>          normal_stress, shear_stress; ///< [Pa]
    std::vector<double>          normal_strain, damage;       ///< [-]
  };
} // namespace dem
