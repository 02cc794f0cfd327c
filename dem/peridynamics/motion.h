#pragma once

#include "dem/peridynamics/bond_forces.h"
#include "dem/peridynamics/loads.h"
#include "dem/peridynamics/repulsion.h"

#include <optional>

namespace dem::peridynamics
{
  /** Energies of a motion [J]: kinetic + strain + repulsion + released = initial + external, to the error of the steps. */
  struct Energies
  {
    double kinetic = 0, strain = 0;
    double repulsion = 0; ///< stored where nodes without a bond press on each other
    double released  = 0; ///< by bonds that broke
    double external  = 0; ///< work of loads and of prescribed displacements
    double initial   = 0; ///< kinetic energy at the start

    double residual() const { return kinetic + strain + repulsion + released - external - initial; }
    double largest() const;
  };

  /**
   * Explicit motion by the leap-frog scheme (doc/theory/peridynamics.md, 7). The account of energies takes the velocities half a step before
   * and after a time, in which it closes to rounding as long as kinematics is linear.
   */
  class Motion
  {
  public:
    /**
     * Not above the largest step that is stable with the undamaged bonds [s], by Gershgorin.
     * @param repulsion as in repel(); 0: none
     */
    static double stable_step(const Bonds &bonds, double repulsion = 0);

    /**
     * @param velocity at the start [m/s] by place
     * @param step of all steps [s]
     */
    Motion(Bonds &bonds, const Loads &loads, Kinematics kinematics, const Field &velocity, double step);

    /** From now on, before the first step, nodes without a bond repel each other. @param stiffness see Repulsion */
    void repel(const Bonds &bonds, double stiffness) { repulsion.emplace(bonds, stiffness); }

    /** Length of the steps to come [s]. */
    void   set_step(const double seconds) { length = seconds; }
    double step_length() const { return length; }

    void step(Bonds &bonds, const Loads &loads);

    /** What loads say has changed since the last step: take it into account in the next one. */
    void update_loads(const Loads &loads) { find_external(loads); }
    /** Velocity of a node after the next step's forces have acted, if nothing more than now does [m/s]. */
    Eigen::Vector3d velocity_ahead(std::size_t place) const;
    /** Change a node's velocity at once, along what is not held [m/s]; its energy is external work. */
    void   change_velocity(std::size_t place, const Eigen::Vector3d &by, const Loads &loads);
    double mass_of(const std::size_t place) const { return mass[place]; } ///< [kg]
    /** Of the bonds, and of repulsion, at the time [N]. */
    const Field &forces() const { return force; }
    /** Loads, and on what is held the force that moves it as prescribed, inertia included, at the time [N]. */
    const Field &pushes() const { return external; }

    double          time() const { return now; }
    std::int64_t    steps() const { return taken; }
    const Field    &displacement() const { return u; }
    const Field    &velocity() const { return v; } ///< half a step before the time
    Energies        energies(const Bonds &bonds);  ///< at the time
    std::int64_t    broken() const { return gone; }
    std::int64_t    contacts() const { return repulsion ? repulsion->contacts() : 0; } ///< at the time
    Eigen::Vector3d momentum(const Bonds &bonds) const; ///< half a step before the time [kg m/s]
    /** Momentum at the start, and what loads and reactions have given since [N s]. */
    Eigen::Vector3d impulse() const { return {pushed[0], pushed[1], pushed[2]}; }

    void visit_state(base::StateVisitor &visitor);

  private:
    void find_forces(Bonds &bonds, const Loads &loads, bool first);
    /** Loads, and on what is held the force that moves it as prescribed. */
    void   find_external(const Loads &loads);
    double power(const Bonds &bonds) const;
    /** Between the middles of the last step and of the next, in which forces act [s]. */
    double kick() const { return 0.5 * (last_length + length); }

    Kinematics               kinematics;
    BondForces               bond_forces;
    std::optional<Repulsion> repulsion;
    double                   length, last_length, now = 0; ///< of the next step and of the last, and the time [s]
    base::Column             mass;                         ///< by place [kg]
    Field                    u, v, force, external, last_step;
    double                   released = 0, work = 0, start = 0;
    base::Column             pushed;
    std::int64_t             gone = 0, taken = 0;
  };
} // namespace dem::peridynamics
