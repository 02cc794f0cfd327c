#include "apps/drivers/continuum/contact_section.h"

namespace apps
{
  void ContactSection::declare(Section &s)
  {
    using coupling::bodies::BodyContactForm;
    name = s.name();
    s.text("Bodies", bodies, Need::optional)
      .means("Materials of the bodies, separated by commas; empty: all. A body is what hangs together in the mesh");
    s.choice("Form", law.form, {{"potential", BodyContactForm::potential}, {"penalty", BodyContactForm::penalty}},
             Need::optional)
      .means(
        "potential: the force is the slope of an energy of the overlap, and gives back what it took; penalty: it is "
        "in proportion to the volume of the overlap, which is cheaper and keeps energy to some per cent");
    s.number("Stiffness", law.stiffness, "N/m^3", Range::positive(), Need::required)
      .means(
        "Pressure over the depth to which flat faces lie in each other. Ten times Young's modulus over the size of "
        "the elements makes the contact stiffer than they are");
    s.number("Shear ratio", law.shear_ratio, "-", Range::positive(), Need::optional)
      .means("Stiffness of friction that holds over that across the contact")
      .only_if([this] { return law.friction_coefficient > 0; }, "Friction coefficient > 0");
    s.number("Friction coefficient", law.friction_coefficient, "-", Range::at_least(0), Need::optional)
      .means("Of Coulomb's law");
    s.flag("Self-contact", law.self_contact).means("Bodies touch themselves as well, where they fold");
    s.number("Energy limit", energy_limit, "-", Range::positive(), Need::optional)
      .means("The run stops where the contact itself has made or lost more than this part of the largest energy");
  }

  void ContactsSection::declare(Section &root, std::function<bool()> is_explicit)
  {
    Section &s =
      root.section("Contacts", "One sub-section per kind of contact between bodies of the solid; its name is "
                               "part of the columns of series.csv");
    s.only_if(std::move(is_explicit), "Model/Analysis = explicit");
    s.named_sections("CONTACT", [this](Section &opened) { contacts.emplace_back().declare(opened); });
  }

  void ContactsSection::check(const base::EntryPath &root, const bool moves) const
  {
    const base::EntryPath all = root.at("Contacts");
    if (!empty() && !moves)
      all.at(contacts.front().name).refuse("goes with Model/Analysis = explicit.");
    for (const ContactSection &contact : contacts)
      if (contact.name.find_first_of(",\"") != std::string::npos)
        all.at(contact.name).refuse("a name without commas and quotes, please: it is part of columns of series.csv.");
  }
} // namespace apps
