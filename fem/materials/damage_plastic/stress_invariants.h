#pragma once

#include "base/voigt.h"

namespace fem
{
  /// Haigh-Westergaard coordinates of a stress and the directions that carry them back.
  struct StressInvariants
  {
    double      volumetric;     ///< sigma_V = tr / 3 [Pa]
    double      deviatoric;     ///< rho = |s| [Pa]
    double      lode;           ///< theta in [0, pi/3]: 0 on the tensile meridian; pi/6 where rho = 0
    base::Voigt direction;      ///< s / rho (unit tensor, stress-like)
    base::Voigt lode_direction; ///< d direction / d theta at fixed principal axes (unit tensor, stress-like)

    explicit StressInvariants(const base::Voigt &stress);

    /// Largest to smallest principal value of `direction`.
    Eigen::Vector3d principal_direction() const;

    /// Derivative of principal_direction() with theta.
    Eigen::Vector3d principal_lode_direction() const;
  };
}
