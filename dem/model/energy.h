#pragma once

#include <string_view>

namespace dem
{
  /**
 * Where the energy of a specimen is and where it went, at one instant t_n [J].
 *
 * Balance: initial + external_work + gravity = kinetic + elastic + damage + friction + released + damping
 * (doc/theory/energy.md). Kinetic energy is the leap-frog invariant 1/2 m v(n-1/2).v(n+1/2) (+ the same of rotation): together with the
 * elastic energy at t_n it is conserved exactly by a linear system at any stable step, so that the balance error shows the
 * physics' integration and not the sampling.
 */
  struct EnergyAccount
  {
    double initial = 0; ///< kinetic energy given before the first step, and what a static start or overlaps there store
    double external_work = 0; ///< by prescribed motion, and by the stress on a deforming cell, V sigma : G
    double gravity       = 0; ///< work of the weight: potential energy lost since the first step
    double kinetic       = 0; ///< in a periodic cell: of the motion about the cell's
    double elastic       = 0; ///< stored in links and contacts
    double damage        = 0; ///< dissipated by link damage
    double friction      = 0; ///< dissipated by plastic sliding of links and contacts
    double released      = 0; ///< still stored in links and contacts when they were deleted
    double damping       = 0; ///< dissipated by local damping, by dashpots of contacts and by overstress of links
    double rounding =
      0; ///< no part of the balance: what a strain of 1e-11 would store in the bonds; without bonds, in touching particles

    /** input - (stored + dissipated) [J]; zero when every mechanism is accounted for. */
    double residual() const
    {
      return initial + external_work + gravity - (kinetic + elastic + damage + friction + released + damping);
    }

    /**
     * |residual| over the largest amount that took part (initial + |work|, kinetic, elastic, dissipated); 0 for nothing. Amounts below the
     * rounding are none: of a specimen at rest they are all that there is, and balance in no digit.
     */
    double balance_error() const;

    /** Call visitor(name, value) for every term, in the order above, then the residual: the one list for series and summary. */
    template <typename Visitor>
    void each(Visitor &&visitor) const
    {
      visitor("initial", initial);
      visitor("external_work", external_work);
      visitor("gravity", gravity);
      visitor("kinetic", kinetic);
      visitor("elastic", elastic);
      visitor("damage", damage);
      visitor("friction", friction);
      visitor("released", released);
      visitor("damping", damping);
      visitor("residual", residual());
    }
  };
} // namespace dem
