#include "apps/scene/coupled/bond.h"

#include "apps/scene/law_block.h"
#include "apps/scene/section.h"

#include <vector>

namespace apps
{
  void declare(Section &coupling, BondSection &bond)
  {
    Section &section = coupling.section("Bond", "Glue between the particles and the faces, from the start");
    section.number("Within", bond.within, "m", Range::at_least(0), Need::optional)
      .means("Particles are glued to the nearest face where the gap between the two is at most this; 0: none. What is "
             "torn off touches the face as the coupling says");
    const auto              &laws  = dem::link_laws();
    std::vector<std::string> names = {"own"};
    for (const auto &kind : laws)
      names.push_back(kind->name());
    section
      .choice_of(
        "Law", names, 0,
        [&bond, &laws](const std::size_t chosen) { bond.law = chosen == 0 ? nullptr : laws.at(chosen - 1).get(); },
        Need::optional)
      .means(
        "Law of the glue, with the constants of the section of its name; own: that of the links between particles of "
        "one material. The link reaches from the particle's centre to the face")
      .only_if([&bond] { return bond.given(); }, section.path() + "/Within > 0");
    for (const auto &kind : laws)
      {
        Section &block = section.section(kind->name(), kind->meaning());
        block.only_if([&bond, kind] { return bond.law == kind.get(); }, section.path() + "/Law = " + kind->name());
        LawBlock entries(block);
        bond.constants[kind->name()] = kind->constants();
        bond.constants[kind->name()]->visit(entries);
      }
  }
} // namespace apps
