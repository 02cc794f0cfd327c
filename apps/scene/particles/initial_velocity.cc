#include "apps/scene/particles/initial_velocity.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/particles/motion.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, InitialVelocitySection &initial_velocity)
  {
    root
      .section("Initial velocity",
               "One sub-section per group that moves at the start, named after the group; of two groups with the same "
               "particle the later one counts. A rigid body takes the motion that is nearest to the velocities of its "
               "particles, by their masses")
      .named_list("GROUP", initial_velocity.velocities, &MotionFormulas::group,
                  [](Section &opened, MotionFormulas &added) {
                    declare(opened, added,
                            "At the start, by the place of each particle; empty: none, and of a rigid body's "
                            "particles whatever the other components make of it");
                    by_place_alone(opened, "Velocity");
                    by_place_alone(opened, "Spin");
                  });
  }
} // namespace apps
