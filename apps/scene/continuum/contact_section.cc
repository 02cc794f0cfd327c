#include "apps/scene/continuum/contact_section.h"

#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &s, ContactSection &contact)
  {
    using coupling::bodies::BodyContactForm;
    contact.name = s.name();
    declare_names(s, "Bodies", contact.bodies, Need::optional)
      .means("Materials of the bodies, separated by commas; empty: all. A body is what hangs together in the mesh");
    s.choice("Form", contact.law.form,
             {{"potential", BodyContactForm::potential}, {"penalty", BodyContactForm::penalty}}, Need::optional)
      .means(
        "potential: the force is the slope of an energy of the overlap, and gives back what it took; penalty: it is "
        "in proportion to the volume of the overlap, which is cheaper and keeps energy to some per cent");
    s.number("Stiffness", contact.law.stiffness, "N/m^3", Range::positive(), Need::required)
      .means(
        "Pressure over the depth to which flat faces lie in each other. Ten times Young's modulus over the size of "
        "the elements makes the contact stiffer than they are");
    s.number("Shear ratio", contact.law.shear_ratio, "-", Range::positive(), Need::optional)
      .means("Stiffness of friction that holds over that across the contact")
      .only_if([&contact] { return contact.law.friction_coefficient > 0; }, "Friction coefficient > 0");
    s.number("Friction coefficient", contact.law.friction_coefficient, "-", Range::at_least(0), Need::optional)
      .means("Of Coulomb's law");
    s.flag("Self-contact", contact.law.self_contact).means("Bodies touch themselves as well, where they fold");
    s.number("Energy limit", contact.energy_limit, "-", Range::positive(), Need::optional)
      .means("The run stops where the contact itself has made or lost more than this part of the largest energy");
  }

  void declare(Section &root, ContactsSection &contacts, std::function<bool()> is_explicit)
  {
    Section &s =
      root.section("Contacts", "One sub-section per kind of contact between bodies of the solid; its name is "
                               "part of the columns of series.csv");
    s.only_if(std::move(is_explicit), "Model/Analysis = explicit");
    s.named_sections("CONTACT", [&contacts](Section &opened) { declare(opened, contacts.contacts.emplace_back()); });
  }
} // namespace apps
