#pragma once

#include "dem/peridynamics/bond_forces.h"
#include "dem/peridynamics/loads.h"

namespace dem::peridynamics
{
  /** How much the nodes of a relaxation resist. */
  enum class FictitiousDensity
  {
    gershgorin, ///< the least that is proven stable, node by node
    constant    ///< 5/4 of family volume times bond constant over spacing, everywhere: the published example programs
  };

  /**
   * Adaptive dynamic relaxation (doc/theory/peridynamics.md, 6): steps of unit length of a motion whose densities and damping are
   * chosen to come to rest soonest. Kilic, Madenci (2010); Underwood (1983).
   */
  class Relaxation
  {
  public:
    Relaxation(const Bonds &bonds, Kinematics kinematics, FictitiousDensity density);

    /** What acts from now on; the motion goes on. */
    void load(const Loads &loads, double at);

    /** One step. */
    void step(const Bonds &bonds, const Loads &loads);
    /** The same; bonds whose stretch has reached its limit are gone before they pull. @return how many in this step */
    std::int64_t step_and_break(Bonds &bonds, const Loads &loads);

    /** Bonds have broken between steps: what the damping was estimated from is no longer there. */
    void forget_damping() { fresh = 1; }

    const Field &displacement() const { return u; }
    double       residual() const
    {
      return left;
    } ///< before the last step: forces out of balance over loads or reactions [-]
    std::int64_t steps() const { return taken; }
    /** Residual below the tolerance, and over 20 steps no displacement changed by 1e-9 of the largest, or a thousandth of the tolerance if less. */
    bool at_rest(double tolerance) const;

    const BondForces &forces() const { return bond_forces; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void add_loads(const Loads &loads);
    /** Makes of the bonds' forces the force densities out of balance, none where motion is prescribed. */
    void   find_force_density(const Grid &grid, const Loads &loads);
    double damping(const Grid &grid, const Loads &loads) const;
    void   move(const Grid &grid, const Loads &loads);

    Kinematics   kinematics;
    BondForces   bond_forces;
    base::Column density; ///< by place
    Field        u, velocity, force, last_force, external;
    double       at = 0, left = 1, moved = 1;
    std::int64_t taken = 0, fresh = 1;
    base::Column recent; ///< relative changes of the last 20 steps
  };
} // namespace dem::peridynamics
