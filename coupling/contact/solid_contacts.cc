#include "coupling/contact/solid_contacts.h"

#include <algorithm>

namespace coupling
{
  template <int dim>
  SolidContacts<dim>::SolidContacts(const fem::Solid<dim> &solid_, SolidParticipant<dim> &participant_)
    : solid(solid_)
    , participant(participant_)
  {
  }

  template <int dim>
  void SolidContacts<dim>::add(const ContactCouplingParameters &parameters)
  {
    contacts.push_back(std::make_unique<ContactCoupling<dim>>(solid, participant, parameters));
    find();
  }

  template <int dim>
  void SolidContacts<dim>::find()
  {
    double added = 0;
    for (const auto &contact : contacts)
      {
        contact->kinematics_to_dem();
        added += contact->added_eigenvalue();
      }
    largest_added = std::max(largest_added, added);
  }

  template <int dim>
  void SolidContacts<dim>::push(const double kick)
  {
    for (const auto &contact : contacts)
      contact->forces_to_fem(kick);
  }

  template <int dim>
  void SolidContacts<dim>::visit_state(base::StateVisitor &visitor)
  {
    if (contacts.empty())
      return;
    visitor.scalar("stiffest_body_contacts", largest_added);
    for (const auto &contact : contacts)
      contact->visit_state(visitor);
  }

  template class SolidContacts<2>;
  template class SolidContacts<3>;
} // namespace coupling
