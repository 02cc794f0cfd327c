#include "apps/scene/entries/contact_law.h"

#include "apps/scene/law_block.h"
#include "apps/scene/section.h"

#include <vector>

namespace apps
{
  namespace
  {
    /** Laws that surfaces can have besides the linear one, whose constants stand in the section itself. */
    std::vector<std::shared_ptr<const dem::LinkLawKind>> other_laws()
    {
      std::vector<std::shared_ptr<const dem::LinkLawKind>> found;
      for (const auto &kind : dem::link_laws())
        if (kind->touches_only() && kind->name() != dem::LinearContactLaw::name)
          found.push_back(kind);
      return found;
    }
  } // namespace

  void declare(Section &section, ContactLaw &contact_law, const std::function<bool()> &used, const std::string &words)
  {
    const auto all_of = [&](std::function<bool()> holds) {
      return [used, holds] { return (!used || used()) && holds(); };
    };
    const auto in_words = [&](const std::string &law) {
      return words.empty() ? "its Law = " + law : words + ", and Law = " + law;
    };
    const auto               others = other_laws();
    std::vector<std::string> names  = {dem::LinearContactLaw::name};
    for (const auto &kind : others)
      names.push_back(kind->name());
    Entry &law = section.choice_of(
      "Law", names, 0,
      [&contact_law, others](const std::size_t chosen) {
        contact_law.other = chosen == 0 ? nullptr : others.at(chosen - 1).get();
      },
      Need::optional);
    law.means("Law of contacts with particles. Constants of linear contacts stand here, those of another law in the "
              "section of its name");
    if (used)
      law.only_if(used, words);
    const auto        is_linear       = all_of([&contact_law] { return contact_law.other == nullptr; });
    const std::string linear_in_words = in_words(dem::LinearContactLaw::name);
    section.number("Effective modulus", contact_law.linear.effective_modulus, "Pa", Range::positive(), Need::required)
      .means("E*: normal stiffness with a sphere of radius r is pi r E*; with a disc 2 t E*")
      .only_if(is_linear, linear_in_words);
    section.number("Stiffness ratio", contact_law.linear.stiffness_ratio, "-", Range::positive(), Need::optional)
      .means("Normal over shear stiffness")
      .only_if(is_linear, linear_in_words);
    section
      .number("Friction coefficient", contact_law.linear.friction_coefficient, "-", Range::at_least(0), Need::optional)
      .means("Shear force that sliding keeps over the normal one")
      .only_if(is_linear, linear_in_words);
    section
      .number("Restitution", contact_law.linear.restitution, "-", Range{dem::smallest_restitution, 1.0, false},
              Need::optional)
      .means(dem::restitution_meaning)
      .only_if(is_linear, linear_in_words);
    for (const auto &kind : others)
      {
        Section &block = section.section(kind->name(), kind->meaning());
        block.only_if(all_of([&contact_law, kind] { return contact_law.other == kind.get(); }), in_words(kind->name()));
        LawBlock entries(block);
        contact_law.constants[kind->name()] = kind->constants();
        contact_law.constants[kind->name()]->visit(entries);
      }
  }
} // namespace apps
