#include "apps/scene/particles/forces.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, ForcesSection &forces)
  {
    root
      .section("Forces", "One sub-section per group that is pushed from outside, named after the group; of groups with "
                         "the same particle all count")
      .named_list("GROUP", forces.forces, &GroupForce::group, [](Section &opened, GroupForce &added) {
        declare_components(opened, "Force", added.force, "N",
                           "On each particle of the group, by its place x, y, z and time t; empty: none");
      });
  }
} // namespace apps
