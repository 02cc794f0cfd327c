#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace dem
{
  /** Breaks near each other in place and time, heard as one (doc/theory/acoustic-emission.md). */
  struct EmissionEvent
  {
    double          time       = 0;                            ///< of its first break [s]
    double          lasts      = 0;                            ///< from its first break to its last [s]
    Eigen::Vector3d place      = {0, 0, 0};                    ///< mean of its breaks, by area [m]
    double          area       = 0;                            ///< of what broke [m^2]
    std::int64_t    in_tension = 0, in_shear = 0, gradual = 0; ///< how many broke in which way
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();          ///< symmetric, when its scalar was largest [N m]

    std::int64_t breaks() const { return in_tension + in_shear + gradual; }
  };
} // namespace dem
