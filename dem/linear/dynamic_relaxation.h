#pragma once

#include "dem/linear/iterations.h"

namespace dem
{
  /** How a linear network is shaken to rest. */
  struct DynamicRelaxationParameters
  {
    double          damping     = 0.2; ///< local (Cundall) damping D, in (0, 1)
    double          step_factor = 0.8; ///< time step over the stable one, in (0, 1)
    IterationLimits limits;            ///< an iteration is a time step
  };

  /**
   * What conjugate_gradients() solves, by the explicit dynamics of particle codes: unit masses scaled to each motion's
   * stiffness, leap-frog steps, and local damping a (1 - D sign(a v)) (Cundall and Strack, 1979).
   *
   * It is here to be compared with: the cost of a static answer had by relaxation, in the same kernel and for all load cases
   * at once.
   */
  IterationReport relax_dynamically(const StiffnessOperator              &stiffness,
                                    const Fields                         &b,
                                    Fields                               &x,
                                    const std::array<double, load_lanes> &reference,
                                    const DynamicRelaxationParameters    &parameters);
} // namespace dem
