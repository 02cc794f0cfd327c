#include "apps/scene/entries/material.h"

#include "apps/scene/entries/material_region.h"
#include "apps/scene/law_block.h"
#include "apps/scene/section.h"

#include <fmt/ranges.h>

namespace apps
{
  void declare(Section &section, LinkLaw &link_law)
  {
    const auto              &laws = dem::link_laws();
    std::vector<std::string> names;
    link_law.law = laws.front().get();
    for (const auto &kind : laws)
      names.push_back(kind->name());
    section
      .choice_of(
        "Law", names, 0, [&link_law, &laws](const std::size_t chosen) { link_law.law = laws.at(chosen).get(); },
        Need::required)
      .notes(link_law.given)
      .means("Law of the links; the section of its name holds its constants");
    std::vector<std::string> of_contacts = {"own"};
    of_contacts.insert(of_contacts.end(), names.begin(), names.end());
    section
      .choice_of(
        "Contacts", of_contacts, 0,
        [&link_law, &laws](const std::size_t chosen) {
          link_law.contacts = chosen == 0 ? nullptr : laws.at(chosen - 1).get();
        },
        Need::optional)
      .means("Law of what is born where particles meet; own: as Law leaves a broken link. Its constants stand in the "
             "section of its name");
    for (const auto &kind : laws)
      {
        Section &block = section.section(kind->name(), kind->meaning());
        block.only_if([&link_law, kind] { return link_law.law == kind.get() || link_law.contacts == kind.get(); },
                      section.path() + "/Law or Contacts = " + kind->name());
        LawBlock entries(block);
        link_law.constants[kind->name()] = kind->constants();
        link_law.constants[kind->name()]->visit(entries);
      }
  }

  namespace
  {
    void declare_interface_factors(Section &section, MaterialInterface &material_interface)
    {
      using Constants = MaterialInterface::Constants;
      section
        .choice("Constants", material_interface.from, {{"own", Constants::own}, {"factors", Constants::factors}},
                Need::optional)
        .means("own: in the section of its law; factors: those of Material, by its law, times the factors");
      dem::ConstantFactors &by     = material_interface.factors;
      const auto            number = [&](const char *entry, double &member, const char *meaning) {
        section.number(entry, member, "-", Range::positive(), Need::optional)
          .means(meaning)
          .only_if([&material_interface] { return material_interface.from == Constants::factors; },
                   section.path() + "/Constants = factors");
      };
      number("Stiffness factor", by.stiffness, "Of the moduli of Material");
      number("Strength factor", by.strength,
             "Of its strengths and cohesions; of its limit elastic strain this over the stiffness factor");
      number("Ductility factor", by.ductility, "Of its relative ductility");
    }
  } // namespace

  void declare(Section &section, MaterialInterface &material_interface, const std::list<NamedMaterial> &materials)
  {
    declare_pair(section, material_interface.one, material_interface.other, "links between its own particles");
    std::vector<std::string> laws = {"of the materials"};
    for (const auto &kind : dem::link_laws())
      laws.push_back(kind->name());
    section
      .choice_of(
        "Law", laws, 0,
        [&material_interface](const std::size_t chosen) {
          material_interface.law = chosen == 0 ? nullptr : dem::link_laws().at(chosen - 1).get();
        },
        Need::optional)
      .means("Law of its links, where it is not that of both materials");
    section.flag("Bonded", material_interface.bonded).means("The two are linked at the start; off: they only touch");
    declare_interface_factors(section, material_interface);
    for (const auto &kind : dem::link_laws())
      {
        Section &block = section.section(kind->name(), kind->meaning());
        block.only_if(
          [&material_interface, &materials, kind] {
            return !materials.empty() && material_interface.from == MaterialInterface::Constants::own &&
                   (material_interface.law_among(materials) == kind.get() ||
                    materials.front().law.contacts == kind.get());
          },
          "Constants = own, and its Law, or Contacts of the materials, = " + kind->name());
        LawBlock entries(block);
        material_interface.constants[kind->name()] = kind->constants();
        material_interface.constants[kind->name()]->visit(entries);
      }
  }

  void declare(Section &root, MaterialSection &material, const bool inertia)
  {
    Section &section = root.section("Material", "The material of the links, if there is one for all");
    section.only_if([&material] { return material.named.empty(); }, "there is no section Materials");
    declare(section, material.only);

    Section &several = root.section(
      "Materials", "One sub-section per material; a link between particles of two takes the means of their constants");
    several.only_if([&material] { return !material.named.empty(); }, "there are several materials");
    several.named_list("MATERIAL", material.named, &NamedMaterial::name,
                       [inertia](Section &opened, NamedMaterial &added) {
                         declare(opened, added.law);
                         if (inertia)
                           opened.number("Density", added.density, "kg/m^3", Range::at_least(0), Need::optional)
                             .means("Of its particles, not of the bulk; 0: Specimen/Density");
                       });

    Section &between =
      root.section("Interfaces", "One sub-section per pair of materials whose links do not take the means");
    between.only_if([&material] { return !material.interfaces.empty(); }, "there are several materials");
    between.named_list(
      "INTERFACE", material.interfaces, &MaterialInterface::name,
      [&material](Section &opened, MaterialInterface &added) { declare(opened, added, material.named); });

    declare_regions(root, material.regions, "particles");
  }
} // namespace apps
