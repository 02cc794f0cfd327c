#pragma once

#include "coupling/contact/rigid_bodies.h"
#include "coupling/contact/solid_contacts.h"

namespace coupling
{
  /** A solid whose bodies touch each other, in explicit motion: steps as long as its contacts allow. */
  template <int dim>
  class ContactMotion
  {
  public:
    /** @param rigid materials of bodies that do not deform. The others must outlive it. @throws as RigidBodies */
    ContactMotion(const fem::Solid<dim>          &solid,
                  fem::ExplicitSolver<dim>       &motion,
                  SolidParticipant<dim>          &participant,
                  const std::vector<std::string> &rigid = {});

    /** To be added to before the first step. */
    SolidContacts<dim>       &contacts() { return bodies; }
    const SolidContacts<dim> &contacts() const { return bodies; }

    /** Longest step now [s]: 2 s / sqrt(omega^2 + what contacts add), omega the solid's own largest frequency, s its safety. */
    double step() const;
    /** One step, of those that end together after the rest [s]. @throws fem::MaterialFailure, base::NumericalError */
    void advance(double rest);

    /** What is not the solid's. A reader must have the same contacts. */
    void visit_state(base::StateVisitor &visitor);

  private:
    fem::ExplicitSolver<dim> &motion;
    SolidParticipant<dim>    &participant;
    SolidContacts<dim>        bodies;
    RigidBodies<dim>          rigid;
    double                    last_step = 0; ///< [s]; 0: none yet
  };

  /** Longest step of a solid on which contacts push [s]. @param added by them to the squares of its frequencies [1/s^2] */
  template <int dim>
  double step_with_contacts(const fem::ExplicitSolver<dim> &motion, double added);

  /** Time that forces push for in a step: half of it and half of the one before (leapfrog). */
  inline double kick_of(const double step, const double last) { return 0.5 * ((last > 0 ? last : step) + step); }
} // namespace coupling
