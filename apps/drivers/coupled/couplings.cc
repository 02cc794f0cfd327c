#include "apps/drivers/coupled/couplings.h"

#include "apps/drivers/particles/contact_entries.h"

namespace apps
{
  void CouplingSection::declare(Section &s)
  {
    name = s.name();
    s.text("Boundary", boundary, Need::optional)
      .means("Names of parts of the solid's boundary, separated by commas; empty: all of it");
    s.choice("Contact", pressure, {{"point", false}, {"pressure", true}}, Need::optional)
      .means("point: each particle pushes where it is deepest in the surface, for particles that are small beside the "
             "faces of "
             "the elements; pressure: it presses on all of the surface that it covers, for particles that are large "
             "beside them");
    declare_contact(s, contact);
    s.find_entry("Effective modulus")
      ->means(
        "E*: at a point, normal stiffness with a sphere of radius r is pi r E*, with a disc 2 t E*; pressure is E* "
        "times the overlap over the skin: of the order of the solid's Young modulus");
    s.number("Skin thickness", skin, "m", Range::at_least(0), Need::optional)
      .means("In which the pressure builds up; 0: a twentieth of the size of the smallest face")
      .only_if([this] { return pressure; }, "Contact = pressure");
    s.number("Energy limit", energy_limit, "-", Range::positive(), Need::optional)
      .means("The run stops where the coupling itself has made or lost more than this part of the largest energy");
  }

  std::vector<std::string> CouplingSection::boundaries() const
  {
    std::vector<std::string> names;
    for (std::size_t from = 0; from < boundary.size();)
      {
        const std::size_t to    = std::min(boundary.find(',', from), boundary.size());
        const std::size_t first = boundary.find_first_not_of(' ', from), last = boundary.find_last_not_of(' ', to - 1);
        if (first < to)
          names.push_back(boundary.substr(first, last - first + 1));
        from = to + 1;
      }
    return names;
  }

  void CouplingsSection::declare(Section &root)
  {
    root
      .section("Couplings", "One sub-section per surface of the solid that particles touch; its name is part of the "
                            "columns of series.csv")
      .named_sections("COUPLING", [this](Section &opened) { couplings.emplace_back().declare(opened); });
  }

  void CouplingsSection::validate(const Section &root) const
  {
    const Section &all = *root.find_section("Couplings");
    if (couplings.empty())
      throw dem::InputError("Couplings: there is none. Name a surface of the solid that particles touch: subsection "
                            "Couplings/NAME with set Boundary and set Effective modulus.");
    for (const CouplingSection &coupling : couplings)
      for (std::size_t c = 0; c < coupling.name.size(); ++c)
        if (coupling.name[c] == ',' || coupling.name[c] == '"')
          throw dem::InputError(all.find_section(coupling.name)->place().text() + ": Couplings/" + coupling.name +
                                ": a name without commas and quotes, please: it is part of columns of series.csv.");
  }
} // namespace apps
