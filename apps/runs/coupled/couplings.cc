#include "apps/runs/coupled/couplings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

namespace apps
{
  namespace
  {
    /** Packing number of a particle that both are of. */
    std::optional<std::size_t>
    shared_particle(const CouplingSection &one, const CouplingSection &other, const ParticleGroups &groups)
    {
      const auto members = [&](const CouplingSection &c) {
        const auto named = c.particles(groups);
        return named.empty() ? groups.at(GroupNames::all) : named;
      };
      const auto               a = members(one), b = members(other); // sorted
      std::vector<std::size_t> both_have;
      std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both_have));
      return both_have.empty() ? std::nullopt : std::optional<std::size_t>(both_have.front());
    }
  } // namespace

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

  void CouplingsSection::refuse_shared(const ParticleGroups                                                &groups,
                                       const std::function<bool(const std::string &, const std::string &)> &same) const
  {
    const auto share = [&](const std::vector<std::string> &a, const std::vector<std::string> &b) {
      return a.empty() || b.empty() || std::find_first_of(a.begin(), a.end(), b.begin(), b.end(), same) != a.end();
    };
    for (auto one = couplings.begin(); one != couplings.end(); ++one)
      for (auto other = std::next(one); other != couplings.end(); ++other)
        if (share(one->boundaries, other->boundaries))
          if (const auto pushed = shared_particle(*one, *other, groups))
            throw base::InputError(fmt::format("Couplings/{} and Couplings/{}: both are of particle {} and of the same "
                                               "boundary: it would be pushed twice. Give them different Groups or a "
                                               "different Boundary.",
                                               one->name, other->name, *pushed + 1));
  }
} // namespace apps
