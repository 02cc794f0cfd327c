#pragma once

#include "dem/peridynamics/loads.h"
#include "dem/peridynamics/stiffness.h"

namespace dem::peridynamics
{
  /** How far bonds are stretched. */
  struct LargestStretch
  {
    double of_limit =
      0; ///< largest stretch over the one at which the bond breaks [-]; 0 where none is stretched or none breaks
    double value = 0; ///< largest stretch of any bond [-]
  };
  LargestStretch largest_stretch(const Bonds &bonds, const BondForces &forces, const Field &u);

  /**
   * Break the bonds whose stretch has reached its limit.
   * @param part only those stretched at least this part of the most stretched one, over their limits; 0: all
   * @return how many
   */
  std::int64_t break_stretched(Bonds &bonds, const BondForces &forces, const Field &u, double part);

  /**
   * Equilibria of a body under loads that grow (doc/theory/peridynamics.md, 5): Newton's method on sparse factors, one solution each in
   * linear kinematics.
   */
  class Equilibrium
  {
  public:
    Equilibrium(const Bonds &bonds, Kinematics kinematics, Solver solver);

    /** Where the body stands. */
    struct State
    {
      int    solutions = 0;
      double residual  = 0; ///< force out of balance over the loads or reactions [-]
      bool loose = false; ///< a piece that nothing holds carries a load, or it is a mechanism: there is no equilibrium
      bool mechanism =
        false; ///< every piece is held, but nearly broken nodes move under their load, or the body is not stable
      double imbalance = 0; ///< of that load, see RigidMotions
    };

    /**
     * @param u in: a state nearby; out: of the equilibrium
     * @param tolerance of the residual, and of the imbalance of loads on what moves freely
     * @throws base::NumericalError where Newton's method does not converge though no bond is broken
     */
    State find(const Bonds &bonds, const Loads &loads, double at, double tolerance, Field &u);

    BondForces &forces() { return bond_forces; }

  private:
    Kinematics kinematics;
    BondForces bond_forces;
    Stiffness  stiffness;
  };
} // namespace dem::peridynamics
