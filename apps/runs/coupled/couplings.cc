#include "apps/runs/coupled/couplings.h"

#include <set>

namespace apps
{
  std::vector<std::size_t> CouplingSection::particles(const ParticleGroups &of_all) const
  {
    std::set<std::size_t> members;
    for (const std::string &named : groups)
      members.insert(of_all.at(named).begin(), of_all.at(named).end());
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
        for (const std::string &group : coupling.groups)
          groups.require(section, "Groups", group);
        coupling.contact.check(section);
        coupling.bond.check(section);
      }
  }
} // namespace apps
