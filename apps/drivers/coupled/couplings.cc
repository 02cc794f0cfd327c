#include "apps/drivers/coupled/couplings.h"

#include "apps/scene/name_list.h"

#include <algorithm>
#include <set>

namespace apps
{
  void CouplingSection::declare(Section &s)
  {
    name = s.name();
    s.text("Boundary", boundary, Need::optional)
      .means("Names of parts of the solid's boundary, separated by commas, z max as well as front; empty: all of it");
    s.text("Groups", group, Need::optional)
      .means("Names of groups of particles (sections Groups and More particles), separated by commas; empty: all");
    s.choice("Contact", pressure, {{"point", false}, {"pressure", true}}, Need::optional)
      .means("point: each particle pushes where it is deepest in the surface, for particles that are small beside the "
             "faces of "
             "the elements; pressure: it presses on all of the surface that it covers, for particles that are large "
             "beside them");
    s.choice("Spreading", spreading,
             {{"none", coupling::Spreading::none},
              {"automatic", coupling::Spreading::automatic},
              {"footprint", coupling::Spreading::footprint}},
             Need::optional)
      .means(
        "footprint: a particle that pushes at a point acts on a square of the surface as wide as itself, so that a "
        "layer of particles presses evenly whatever the size of the faces; automatic: where a particle is larger "
        "than the smallest face; none: on the face at the point alone")
      .only_if([this] { return !pressure; }, "Contact = point");
    contact.declare(s);
    s.find_entry("Effective modulus")
      ->means(
        "E*: at a point, normal stiffness with a sphere of radius r is pi r E*, with a disc 2 t E*; pressure is E* "
        "times the overlap over the skin: of the order of the solid's Young modulus");
    s.number("Skin thickness", skin, "m", Range::at_least(0), Need::optional)
      .means("In which the pressure builds up; 0: a twentieth of the size of the smallest face")
      .only_if([this] { return pressure; }, "Contact = pressure");
    s.number("Energy limit", energy_limit, "-", Range::positive(), Need::optional)
      .means("The run stops where the coupling itself has made or lost more than this part of the largest energy");
    bond.declare(s);
  }

  std::vector<std::string> CouplingSection::boundaries() const { return names_in(boundary); }

  std::vector<std::size_t> CouplingSection::particles(const ParticleGroups &groups) const
  {
    std::set<std::size_t> members;
    for (const std::string &named : names_in(group))
      members.insert(groups.at(named).begin(), groups.at(named).end());
    return {members.begin(), members.end()};
  }

  void CouplingsSection::declare(Section &root)
  {
    root
      .section("Couplings", "One sub-section per surface of the solid that particles touch; its name is part of the "
                            "columns of series.csv")
      .named_sections("COUPLING", [this](Section &opened) { couplings.emplace_back().declare(opened); });
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
