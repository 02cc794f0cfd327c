#pragma once

#include "base/voigt.h"

namespace fem
{
  /// What a discrete model, or the user, knows about a point before the first step.
  struct InitialPointState
  {
    base::Voigt stress    = base::Voigt::Zero(); ///< [Pa], at zero strain
    double      damage    = 0.0;                 ///< omega in [0, 1]; 1 is taken as 1 - 1e-6
    double      hardening = 0.0;                 ///< used where the point is undamaged; must then be below 1
  };

  /// What a material bears under uniaxial stress, in magnitude [Pa].
  struct UniaxialStrengths
  {
    double tension = 0, compression = 0;
  };
}
