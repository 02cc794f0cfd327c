#include "apps/runs/continuum/contacts.h"

#include "apps/results/run_work.h"
#include "apps/runs/continuum/probes.h"

#include <fmt/format.h>

namespace apps
{
  template <int dim>
  ObservedContacts<dim>::ObservedContacts(const ContactsSection &requested, coupling::SolidContacts<dim> &given)
    : section(requested)
    , contacts(given)
  {
    for (const ContactSection &contact : section.contacts)
      try
        {
          given.add({contact.name, contact.bodies, contact.law});
        }
      catch (const base::InputError &refusal)
        {
          throw base::InputError("Contacts/" + contact.name + ": " + refusal.what());
        }
  }

  template <int dim>
  ContactEnergies ObservedContacts<dim>::energies() const
  {
    ContactEnergies sum;
    for (const auto &contact : contacts.all())
      {
        const coupling::ContactBalance &b = contact->balance();
        sum.work += b.work;
        sum.held += b.energy.normal + b.energy.shear + b.energy.dissipated;
      }
    return sum;
  }

  template <int dim>
  std::vector<postprocess::SeriesColumn> ObservedContacts<dim>::force_columns() const
  {
    std::vector<postprocess::SeriesColumn> all;
    for (const auto &contact : contacts.all())
      for (const std::string &body : contact->contacts().mesh().bodies)
        for (int d = 0; d < dim; ++d)
          all.push_back({column_name(contact->name() + "_" + body) + "_force_" + "xyz"[d], "N"});
    return all;
  }

  template <int dim>
  std::vector<double> ObservedContacts<dim>::forces() const
  {
    std::vector<double> all;
    for (const auto &contact : contacts.all())
      for (const Eigen::Vector3d &force : contact->contacts().on_body())
        for (int d = 0; d < dim; ++d)
          all.push_back(force[d]);
    return all;
  }

  template <int dim>
  std::vector<postprocess::SeriesColumn> ObservedContacts<dim>::columns() const
  {
    std::vector<postprocess::SeriesColumn> all;
    for (const auto &contact : contacts.all())
      {
        const std::string name = column_name(contact->name());
        all.push_back({name + "_pairs", ""});
        all.push_back({name + "_overlap", "m^3"});
        for (const char *energy : {"_stored", "_dissipated", "_spurious"})
          all.push_back({name + energy, "J"});
      }
    return all;
  }

  template <int dim>
  std::vector<double> ObservedContacts<dim>::values() const
  {
    std::vector<double> all;
    for (const auto &contact : contacts.all())
      {
        const coupling::ContactBalance &b = contact->balance();
        all.insert(all.end(), {static_cast<double>(contact->contacts().touching()), contact->contacts().overlap(),
                               b.energy.normal + b.energy.shear, b.energy.dissipated, b.spurious()});
      }
    return all;
  }

  template <int dim>
  void ObservedContacts<dim>::note(ContactFigures &figures, const double time) const
  {
    for (const auto &contact : contacts.all())
      if (contact->contacts().touching() > 0)
        for (const Eigen::Vector3d &force : contact->contacts().on_body())
          if (figures.note(time, force.norm()))
            {
              const coupling::bodies::ContactPatch patch = contact->contacts().patch();
              figures.patch                              = patch.area;
              figures.face                               = patch.face;
            }
  }

  template <int dim>
  void ObservedContacts<dim>::require_balance(const double largest, const double time) const
  {
    auto limit = section.contacts.begin();
    for (const auto &contact : contacts.all())
      {
        const double made = contact->balance().spurious();
        if (std::fabs(made) > limit->energy_limit * largest)
          throw StoppedShort(fmt::format("Contacts/{}: at {:.6g} s the contact has made {:.3g} J by itself, more than "
                                         "Energy limit = {} of the largest energy, {:.3g} J. Lower Motion/Safety{}",
                                         limit->name, time, made, limit->energy_limit, largest,
                                         limit->law.form == coupling::bodies::BodyContactForm::potential ?
                                           " or the stiffness." :
                                           ", or take Form = potential."));
        ++limit;
      }
  }

  template class ObservedContacts<2>;
  template class ObservedContacts<3>;
} // namespace apps
