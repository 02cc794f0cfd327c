#include "apps/scene/continuum/loads.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    template <typename Named>
    Named &opened_in(std::vector<std::unique_ptr<Named>> &list, const Section &section)
    {
      list.push_back(std::make_unique<Named>());
      list.back()->name  = section.name();
      list.back()->place = section.place();
      return *list.back();
    }
  } // namespace

  void declare(Section &root, LoadsSection &loads)
  {
    Section &conditions =
      root.section("Boundary conditions", "One sub-section per named boundary that is held, moved or loaded");
    conditions.named_sections("BOUNDARY", [&loads](Section &s) {
      BoundaryCondition &b = opened_in(loads.boundaries, s);
      declare_components(s, "Displacement", b.displacement, "m", "Prescribed; empty: free");
      declare_components(s, "Traction", b.traction, "Pa", "Force per undeformed area; empty: none");
      s.expression("Pressure", b.pressure, "Pa").means("Against the outward normal; empty: none");
    });

    Section &held =
      root.section("Supports", "Prescribed displacements of all nodes in a box: a point, a line, a patch");
    held.named_sections("SUPPORT", [&loads](Section &s) {
      NodeSupport &support = opened_in(loads.supports, s);
      s.vector("From", support.from, "m", {}, Need::required).means("Lowest corner of the box, or its only point");
      Entry &to = s.vector("To", support.to, "m", {}, Need::optional).means("Highest corner; empty: the same point");
      to.value.clear();
      const auto store = to.store;
      to.store         = [&support, store](const std::string &text, const Place &from) -> std::string {
        support.is_box = !text.empty();
        return text.empty() ? "" : store(text, from);
      };
      declare_components(s, "Displacement", support.displacement, "m", "Prescribed; empty: free");
    });

    Section &single = root.section("Point forces", "Forces at any place in the solid");
    single.named_sections("FORCE", [&loads](Section &s) {
      PointLoad &force = opened_in(loads.forces, s);
      s.vector("Position", force.position, "m", {}, Need::required).means("Undeformed");
      declare_components(s, "Force", force.force, "N", "A function of t; empty: none");
    });

    Section &body = root.section("Body force", "Force per undeformed volume, e.g. the weight");
    declare_components(body, "", loads.body_force, "N/m^3", "Empty: none");

    Section &watched = root.section("Points", "Places whose displacement is recorded");
    watched.named_sections("POINT", [&loads](Section &s) {
      NamedPoint &point = opened_in(loads.points, s);
      s.vector("Position", point.position, "m", {}, Need::required).means("Undeformed, anywhere in the solid");
    });
  }
} // namespace apps
