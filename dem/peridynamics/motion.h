#pragma once

#include "dem/peridynamics/bond_forces.h"
#include "dem/peridynamics/loads.h"

namespace dem::peridynamics
{
  /** Energies of a motion [J]: kinetic + strain + released = initial + external, to the error of the steps. */
  struct Energies
  {
    double kinetic = 0, strain = 0;
    double released = 0; ///< by bonds that broke
    double external = 0; ///< work of loads and of prescribed displacements
    double initial  = 0; ///< kinetic energy at the start

    double residual() const { return kinetic + strain + released - external - initial; }
    double largest() const;
  };

  /**
   * Explicit motion by the leap-frog scheme (doc/theory/peridynamics.md, 7). The account of energies takes the velocities half a step before
   * and after a time, in which it closes to rounding as long as kinematics is linear.
   */
  class Motion
  {
  public:
    /** Not above the largest step that is stable with the undamaged bonds [s], by Gershgorin. */
    static double stable_step(const Bonds &bonds);

    /**
     * @param velocity at the start [m/s] by place
     * @param step of all steps [s]
     */
    Motion(Bonds &bonds, const Loads &loads, Kinematics kinematics, const Field &velocity, double step);

    void step(Bonds &bonds, const Loads &loads);

    double          time() const { return static_cast<double>(taken) * length; }
    std::int64_t    steps() const { return taken; }
    const Field    &displacement() const { return u; }
    const Field    &velocity() const { return v; } ///< half a step before the time
    Energies        energies(const Bonds &bonds);  ///< at the time
    std::int64_t    broken() const { return gone; }
    Eigen::Vector3d momentum(const Bonds &bonds) const; ///< half a step before the time [kg m/s]
    /** Momentum at the start, and what loads and reactions have given since [N s]. */
    Eigen::Vector3d impulse() const { return {pushed[0], pushed[1], pushed[2]}; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void find_forces(Bonds &bonds, const Loads &loads, bool first);
    /** Loads, and on what is held the force that moves it as prescribed. */
    void   find_external(const Loads &loads);
    double power(const Bonds &bonds) const;

    Kinematics   kinematics;
    BondForces   bond_forces;
    double       length;
    base::Column mass; ///< by place [kg]
    Field        u, v, force, external, last_step;
    double       released = 0, work = 0, start = 0;
    base::Column pushed;
    std::int64_t gone = 0, taken = 0;
  };
} // namespace dem::peridynamics
