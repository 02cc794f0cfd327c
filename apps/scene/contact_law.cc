#include "apps/scene/contact_law.h"

#include "apps/scene/law_block.h"

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

  void ContactLaw::declare(Section &section, const std::function<bool()> &used, const std::string &words)
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
      [this, others](const std::size_t chosen) { other = chosen == 0 ? nullptr : others.at(chosen - 1).get(); },
      Need::optional);
    law.means("Law of contacts with particles. Constants of linear contacts stand here, those of another law in the "
              "section of its name");
    if (used)
      law.only_if(used, words);
    const auto        is_linear       = all_of([this] { return other == nullptr; });
    const std::string linear_in_words = in_words(dem::LinearContactLaw::name);
    section.number("Effective modulus", linear.effective_modulus, "Pa", Range::positive(), Need::required)
      .means("E*: normal stiffness with a sphere of radius r is pi r E*; with a disc 2 t E*")
      .only_if(is_linear, linear_in_words);
    section.number("Stiffness ratio", linear.stiffness_ratio, "-", Range::positive(), Need::optional)
      .means("Normal over shear stiffness")
      .only_if(is_linear, linear_in_words);
    section.number("Friction coefficient", linear.friction_coefficient, "-", Range::at_least(0), Need::optional)
      .means("Shear force that sliding keeps over the normal one")
      .only_if(is_linear, linear_in_words);
    section.number("Restitution", linear.restitution, "-", Range{dem::smallest_restitution, 1.0, false}, Need::optional)
      .means(dem::restitution_meaning)
      .only_if(is_linear, linear_in_words);
    for (const auto &kind : others)
      {
        Section &block = section.section(kind->name(), kind->meaning());
        block.only_if(all_of([this, kind] { return other == kind.get(); }), in_words(kind->name()));
        LawBlock entries(block);
        constants[kind->name()] = kind->constants();
        constants[kind->name()]->visit(entries);
      }
  }

  void ContactLaw::check(const base::EntryPath &section) const
  {
    try
      {
        if (other)
          constants.at(other->name())->check();
        else
          dem::LinearContactLaw::check(linear);
      }
    catch (const base::InputError &error)
      {
        section.refuse("Law", error.what());
      }
  }

  dem::LinkMaterials ContactLaw::materials() const
  {
    if (!other)
      return linear;
    return other->materials({{"", constants.at(other->name()).get(), 0}});
  }
} // namespace apps
