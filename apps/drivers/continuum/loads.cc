#include "apps/drivers/continuum/loads.h"

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

  void LoadsSection::declare(Section &root)
  {
    Section &conditions =
      root.section("Boundary conditions", "One sub-section per named boundary that is held, moved or loaded");
    conditions.named_sections("BOUNDARY", [this](Section &s) {
      BoundaryCondition &b = opened_in(boundaries, s);
      declare_components(s, "Displacement", b.displacement, "m", "Prescribed; empty: free");
      declare_components(s, "Traction", b.traction, "Pa", "Force per undeformed area; empty: none");
      s.expression("Pressure", b.pressure, "Pa").means("Against the outward normal; empty: none");
    });

    Section &held =
      root.section("Supports", "Prescribed displacements of all nodes in a box: a point, a line, a patch");
    held.named_sections("SUPPORT", [this](Section &s) {
      NodeSupport &support = opened_in(supports, s);
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
    single.named_sections("FORCE", [this](Section &s) {
      PointLoad &force = opened_in(forces, s);
      s.vector("Position", force.position, "m", {}, Need::required).means("Undeformed");
      declare_components(s, "Force", force.force, "N", "A function of t; empty: none");
    });

    Section &body = root.section("Body force", "Force per undeformed volume, e.g. the weight");
    declare_components(body, "", body_force, "N/m^3", "Empty: none");

    Section &watched = root.section("Points", "Places whose displacement is recorded");
    watched.named_sections("POINT", [this](Section &s) {
      NamedPoint &point = opened_in(points, s);
      s.vector("Position", point.position, "m", {}, Need::required).means("Undeformed, anywhere in the solid");
    });
  }

  void LoadsSection::check(const base::EntryPath &root, const int dimension) const
  {
    for (const auto &support : supports)
      if (support->is_box)
        for (std::size_t i = 0; i < 3; ++i)
          if (support->to[i] < support->from[i])
            root.at("Supports")
              .at(support->name)
              .refuse("To", std::string("its ") + "xyz"[i] + " is below that of From.");
    if (dimension == 3)
      return;
    const auto refuse_z = [&](const char *section, const std::string &name, const char *entry, const Expression &z) {
      base::EntryPath s = root.at(section);
      if (!name.empty())
        s = s.at(name);
      if (z.given())
        s.refuse(entry, "a plane model has no displacement along z (Model/Dimension = 2). Leave it out.");
    };
    for (const auto &b : boundaries)
      {
        refuse_z("Boundary conditions", b->name, "Displacement z", b->displacement[2]);
        refuse_z("Boundary conditions", b->name, "Traction z", b->traction[2]);
      }
    for (const auto &support : supports)
      refuse_z("Supports", support->name, "Displacement z", support->displacement[2]);
    for (const auto &force : forces)
      refuse_z("Point forces", force->name, "Force z", force->force[2]);
    refuse_z("Body force", "", "z", body_force[2]);
  }
} // namespace apps
