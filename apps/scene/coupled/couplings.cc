#include "apps/scene/coupled/couplings.h"

#include "apps/scene/continuum/model.h"
#include "apps/scene/coupled/bond.h"
#include "apps/scene/entries/contact_law.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &s, CouplingSection &coupling)
  {
    coupling.name = s.name();
    declare_names(s, "Boundary", coupling.boundaries, Need::optional)
      .means("Names of parts of the solid's boundary, separated by commas, z max as well as front; empty: all of it");
    declare_names(s, "Groups", coupling.groups, Need::optional)
      .means("Names of groups of particles (sections Groups and More particles), separated by commas; empty: all");
    s.choice("Contact", coupling.pressure, {{"point", false}, {"pressure", true}}, Need::optional)
      .means("point: each particle pushes where it is deepest in the surface, for particles that are small beside the "
             "faces of "
             "the elements; pressure: it presses on all of the surface that it covers, for particles that are large "
             "beside them");
    s.choice("Spreading", coupling.spreading,
             {{"none", coupling::Spreading::none},
              {"automatic", coupling::Spreading::automatic},
              {"footprint", coupling::Spreading::footprint}},
             Need::optional)
      .means(
        "footprint: a particle that pushes at a point acts on a square of the surface as wide as itself, so that a "
        "layer of particles presses evenly whatever the size of the faces; automatic: where a particle is larger "
        "than the smallest face; none: on the face at the point alone")
      .only_if([&coupling] { return !coupling.pressure; }, "Contact = point");
    declare(s, coupling.contact);
    s.find_entry("Effective modulus")
      ->means(
        "E*: at a point, normal stiffness with a sphere of radius r is pi r E*, with a disc 2 t E*; pressure is E* "
        "times the overlap over the skin: of the order of the solid's Young modulus");
    s.number("Skin thickness", coupling.skin, "m", Range::at_least(0), Need::optional)
      .means("In which the pressure builds up; 0: a twentieth of the size of the smallest face")
      .only_if([&coupling] { return coupling.pressure; }, "Contact = pressure");
    s.number("Energy limit", coupling.energy_limit, "-", Range::positive(), Need::optional)
      .means("The run stops where the coupling itself has made or lost more than this part of the largest energy");
    declare(s, coupling.bond);
  }

  void declare(Section &root, CouplingsSection &couplings)
  {
    root
      .section("Couplings", "One sub-section per surface of the solid that particles touch; its name is part of the "
                            "columns of series.csv")
      .named_sections("COUPLING",
                      [&couplings](Section &opened) { declare(opened, couplings.couplings.emplace_back()); });
  }
} // namespace apps
