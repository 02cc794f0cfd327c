#pragma once

#include "apps/figures/contact_figures.h"
#include "apps/runs/continuum/contact_section.h"
#include "coupling/contact/solid_contacts.h"
#include "postprocess/files/series.h"

namespace apps
{
  /** What all contacts between bodies hold and have lost [J]. */
  struct ContactEnergies
  {
    double work = 0; ///< on the bodies
    double held = 0; ///< stored and dissipated

    double spurious() const { return work + held; } ///< by themselves
  };

  /** The contacts that a scene requests between the bodies of its solid, as a run observes them. */
  template <int dim>
  class ObservedContacts
  {
  public:
    /** Gives the contacts to the solid's. Both must outlive it. @throws base::InputError */
    ObservedContacts(const ContactsSection &section, coupling::SolidContacts<dim> &contacts);

    /** Columns of the series that the summary reports: the force on each body. */
    std::vector<postprocess::SeriesColumn> force_columns() const;
    std::vector<double>                    forces() const;
    /** The others: pairs of bodies that touch, overlap, energies. */
    std::vector<postprocess::SeriesColumn> columns() const;
    std::vector<double>                    values() const;

    ContactEnergies energies() const;
    /** After every step. */
    void note(ContactFigures &figures, double time) const;
    /** @param largest energy so far [J] @throws StoppedShort where a contact has made more than it may of it */
    void require_balance(double largest, double time) const;

  private:
    const ContactsSection              &section;
    const coupling::SolidContacts<dim> &contacts;
  };
} // namespace apps
