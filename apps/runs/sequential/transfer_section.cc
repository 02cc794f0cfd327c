#include "apps/runs/sequential/transfer_section.h"

#include "apps/runs/sequential/law_origin.h"
#include "apps/text/nearest_name.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr const char *own_law = "own", *identified_law = "identify";

    std::vector<std::string> law_names()
    {
      std::vector<std::string> names;
      for (const auto &named : coupling::mapping_laws())
        names.push_back(named.name);
      names.emplace_back(own_law);
      names.emplace_back(identified_law);
      return names;
    }
  } // namespace

  void TransferSection::check(const base::EntryPath &root) const
  {
    const base::EntryPath l     = root.at("Transfer").at("Mapping law");
    const auto            names = law_names();
    if (std::find(names.begin(), names.end(), law) == names.end())
      l.refuse("Law", "there is no such law. " + did_you_mean(law, names));
    if (has_own() && !identified_for.empty() && !LawOrigin::read(identified_for))
      l.refuse("Identified for", "expected the line that breccia transfer --identify writes, \"compression, particles "
                                 "0123456789abcdef, damage-plastic concrete 0123456789abcdef\".");
    chosen().law.validate();
  }

  bool TransferSection::identifies() const { return law == identified_law; }

  bool TransferSection::has_own() const { return law == own_law; }

  coupling::TransferOptions TransferSection::chosen() const
  {
    coupling::TransferOptions all = options;
    all.averaging.fewest          = static_cast<std::size_t>(fewest);
    all.law.weights               = weights;
    if (!has_own())
      all.law = {};
    for (const auto &named : coupling::mapping_laws())
      if (named.name == law)
        all.law = named.law;
    return all;
  }
} // namespace apps
