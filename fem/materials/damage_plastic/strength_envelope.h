#pragma once

#include "fem/materials/damage_plastic/concrete.h"

#include <vector>

namespace fem
{
  /** Strength in plane stress under proportional loading. */
  struct EnvelopePoint
  {
    double angle    = 0;               ///< of the loading direction in the plane of sigma_xx and sigma_yy [rad]
    double stress_x = 0, stress_y = 0; ///< at the peak [Pa]
    double strain_x = 0, strain_y = 0, strain_z = 0; ///< at the peak [-]
    double kappa_p = 0;                              ///< at the peak; 1 is where damage begins
  };

  /**
   * Largest stress that a point bears in one direction of the plane sigma_xx, sigma_yy, the other components being zero.
   *
   * The load factor and all strains are found so that the work-conjugate strain grows: thus the path passes the peak, near
   * which it is repeated in ever shorter steps.
   * @throws base::NumericalError if no peak is found.
   */
  EnvelopePoint strength_towards(const DamagePlasticConcrete &law, double angle);

  /** Kupfer's envelope: so many directions around the circle, from uniaxial tension along x on. */
  std::vector<EnvelopePoint> biaxial_envelope(const DamagePlasticConcrete &law, int directions);
} // namespace fem
