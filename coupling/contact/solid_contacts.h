#pragma once

#include "coupling/contact/contact_coupling.h"

#include <memory>

namespace coupling
{
  /** All contacts between bodies of one solid, as its motion takes them along. */
  template <int dim>
  class SolidContacts
  {
  public:
    /** Both must outlive it. */
    SolidContacts(const fem::Solid<dim> &solid, SolidParticipant<dim> &participant);

    /** Before the first step. @throws as ContactCoupling */
    void add(const ContactCouplingParameters &parameters);

    const std::vector<std::unique_ptr<ContactCoupling<dim>>> &all() const { return contacts; }
    bool                                                      empty() const { return contacts.empty(); }

    /** The bodies are where the nodes are: once per step, after it. @throws base::NumericalError */
    void find();
    /** Push the nodes in the next step. @param kick time that forces push for in it [s] */
    void push(double kick);
    /** Largest bound so far of what contacts add to the squares of the solid's frequencies [1/s^2]. */
    double stiffest() const { return largest_added; }

    /** A reader must have the same contacts. */
    void visit_state(base::StateVisitor &visitor);

  private:
    const fem::Solid<dim>                             &solid;
    SolidParticipant<dim>                             &participant;
    std::vector<std::unique_ptr<ContactCoupling<dim>>> contacts;
    double                                             largest_added = 0;
  };
} // namespace coupling
