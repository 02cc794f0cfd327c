#include "apps/drivers/coupled/bond.h"

#include "apps/scene/law_block.h"

#include <vector>

namespace apps
{
  void BondSection::declare(Section &coupling)
  {
    Section &section = coupling.section("Bond", "Glue between the particles and the faces, from the start");
    section.number("Within", within, "m", Range::at_least(0), Need::optional)
      .means("Particles are glued to the nearest face where the gap between the two is at most this; 0: none. What is "
             "torn off touches the face as the coupling says");
    const auto              &laws  = dem::link_laws();
    std::vector<std::string> names = {"own"};
    for (const auto &kind : laws)
      names.push_back(kind->name());
    section
      .choice_of(
        "Law", names, 0,
        [this, &laws](const std::size_t chosen) { law = chosen == 0 ? nullptr : laws.at(chosen - 1).get(); },
        Need::optional)
      .means(
        "Law of the glue, with the constants of the section of its name; own: that of the links between particles of "
        "one material. The link reaches from the particle's centre to the face")
      .only_if([this] { return given(); }, section.path() + "/Within > 0");
    for (const auto &kind : laws)
      {
        Section &block = section.section(kind->name(), kind->meaning());
        block.only_if([this, kind] { return law == kind.get(); }, section.path() + "/Law = " + kind->name());
        LawBlock entries(block);
        constants[kind->name()] = kind->constants();
        constants[kind->name()]->visit(entries);
      }
  }

  void BondSection::check(const base::EntryPath &coupling) const
  {
    if (law == nullptr)
      return;
    try
      {
        constants.at(law->name())->check();
      }
    catch (const base::InputError &refusal)
      {
        coupling.at("Bond").refuse_within(refusal.what());
      }
  }

  std::shared_ptr<const dem::LinkLaw> BondSection::links(const dem::Physics &physics) const
  {
    if (law == nullptr)
      return nullptr;
    return law->materials({{"", constants.at(law->name()).get(), 0}}).bonds(physics);
  }
} // namespace apps
