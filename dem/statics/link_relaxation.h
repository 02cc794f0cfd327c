#pragma once

#include "dem/statics/damaging_links.h"

#include <cstdint>

namespace dem
{
  /** How damaging links are shaken to rest. */
  struct LinkRelaxationParameters
  {
    double       damping     = 0.7;    ///< local (Cundall) damping D, in (0, 1)
    double       tolerance   = 1e-7;   ///< see Unbalanced::residual
    double       least_borne = 0;      ///< see unbalanced_of() [N]
    std::int64_t ramp_steps  = 200;    ///< over which the driven parameters move
    std::int64_t most_steps  = 200000; ///< with the ramp
  };

  struct LinkRelaxationReport
  {
    std::int64_t steps         = 0;
    bool         converged     = false;
    double       residual      = 0;
    double       external_work = 0; ///< by the parameters that are driven [J]
    double       damped        = 0; ///< taken out by damping, and what was still in motion at the end [J]
  };

  /**
   * Explicit dynamics of the network with the real link laws, damage and sliding committed step by step: what a Newton iteration
   * hands over to when equilibrium is lost (a cascade), and takes over from at the next equilibrium.
   *
   * Leap-frog steps with local damping a (1 - D sign(a v)) (Cundall and Strack, 1979) and masses scaled to the undamaged stiffness
   * (Gershgorin rows), so that the stable step is the same for every motion; free load parameters move as particles do. The others
   * move by `change`, evenly over the ramp, and then stay.
   */
  LinkRelaxationReport relax_links(const LoadedNetwork            &loaded,
                                   DamagingLinks                  &links,
                                   LoadedMotion                   &motion,
                                   const base::Vector6            &change,
                                   const LinkRelaxationParameters &parameters);
} // namespace dem
