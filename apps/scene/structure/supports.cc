#include "apps/scene/structure/supports.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, ParticleSupportsSection &particle_supports)
  {
    root.section("Supports", "One sub-section per group of particles that is held or driven; its name is the group's")
      .named_list("GROUP", particle_supports.supports, &ParticleSupport::group,
                  [](Section &opened, ParticleSupport &added) {
                    declare_components(opened, "Displacement", added.displacement, "m",
                                       "Prescribed, a number times the load factor t, 0 to hold; empty: free");
                    opened.flag("Rotations", added.spins).means("Its particles may turn");
                  });
  }
} // namespace apps
