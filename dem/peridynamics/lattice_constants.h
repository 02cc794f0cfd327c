#pragma once

#include "dem/peridynamics/model.h"

#include <array>
#include <vector>

namespace dem::peridynamics
{
  /** A neighbour on the grid that lies ahead: of two opposite ones, the one with the first non-zero of z, y, x positive. */
  struct Offset
  {
    std::array<int, 3> steps;  ///< along the axes
    double             length; ///< in spacings
    double             part;   ///< of its volume that counts, volume_part()
  };

  /** Half of the neighbours within the horizon, by z, y and x. Bonds reach further than the horizon where volumes are partial. */
  std::vector<Offset> half_family(int dimension, const Horizon &horizon);

  /** How far bonds reach, in spacings. */
  int reach_of(const Horizon &horizon);

  /**
   * Elastic constants of the infinite grid under uniform strain, which one-point quadrature makes differ from the continuum's
   * (doc/theory/peridynamics.md, 3).
   */
  struct LatticeConstants
  {
    int    neighbours = 0;
    double c11 = 0, c12 = 0;          ///< of the plane or of space, over Young's modulus [-]; shear has c12
    double young_modulus         = 0; ///< along an axis, over the continuum's [-]
    double young_modulus_oblique = 0; ///< at 45 degrees to two axes [-]
    double poisson_ratio         = 0; ///< along the axes [-]
    double shear_modulus         = 0; ///< over the continuum's [-]
    double bulk                  = 0; ///< C11 + C12, in space C11 + 2 C12, over the continuum's [-]

    /** What the bond constant is divided by. */
    double factor(Calibration calibration) const;
    /** Of the grid whose bond constant was divided. */
    LatticeConstants calibrated(Calibration calibration) const;
  };

  LatticeConstants lattice_constants(Space space, BondModel model, const Horizon &horizon);
} // namespace dem::peridynamics
