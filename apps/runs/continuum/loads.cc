#include "apps/runs/continuum/loads.h"

namespace apps
{
  namespace
  {
  } // namespace

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
