#pragma once

#include "base/state.h"

namespace dem
{
  /**
   * Energy that has crossed a boundary in time. Forces are known at t_n, velocities half a step before and after: the account is struck at t_n,
   * and what the half step after it brings is entered apart.
   */
  struct EnergyFlow
  {
    double before = 0; ///< up to the last half step before t_n [J]
    double now    = 0; ///< in that half step [J]
    double after  = 0; ///< in the half step after t_n [J]

    double at_forces() const { return before + now; } ///< all of it up to t_n [J]
    void   next_step()
    {
      before += now + after;
      now = after = 0;
    }
    void visit_state(base::StateVisitor &visitor, const char *name);
  };

  /** What a specimen keeps of its energy balance, beside what its particles, links and surfaces say of themselves. */
  struct EnergyBook
  {
    double     initial         = 0; ///< kinetic and stored, when the first step began [J]
    double     stored_at_start = 0; ///< of it in links, in an initial equilibrium [J]
    double     weight_at_start = 0; ///< work of the weight up to then [J]
    EnergyFlow work;                ///< by grips, surfaces and forces from outside
    EnergyFlow damped;              ///< dissipated by local damping
    double     released = 0;        ///< stored in links that were deleted [J]
    double     rounding = 0;        ///< see EnergyAccount::rounding [J]

    void visit_state(base::StateVisitor &visitor);
  };
} // namespace dem
