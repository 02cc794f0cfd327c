#include "apps/runs/coupled/couplings.h"

#include "apps/text/name_list.h"

#include <set>

namespace apps
{
  std::vector<std::string> CouplingSection::boundaries() const { return names_in(boundary); }

  std::vector<std::size_t> CouplingSection::particles(const ParticleGroups &groups) const
  {
    std::set<std::size_t> members;
    for (const std::string &named : names_in(group))
      members.insert(groups.at(named).begin(), groups.at(named).end());
    return {members.begin(), members.end()};
  }

  void CouplingsSection::check(const base::EntryPath &root, const GroupNames &groups, const bool alone) const
  {
    const base::EntryPath all = root.at("Couplings");
    if (couplings.empty() && alone)
      throw base::InputError("Couplings: there is none. Name a surface of the solid that particles touch: subsection "
                             "Couplings/NAME with set Boundary and set Effective modulus.");
    for (const CouplingSection &coupling : couplings)
      {
        const base::EntryPath section = all.at(coupling.name);
        if (coupling.name.find_first_of(",\"") != std::string::npos)
          section.refuse("a name without commas and quotes, please: it is part of columns of series.csv.");
        for (const std::string &group : names_in(coupling.group))
          groups.require(section, "Groups", group);
        coupling.contact.check(section);
        coupling.bond.check(section);
      }
  }
} // namespace apps
