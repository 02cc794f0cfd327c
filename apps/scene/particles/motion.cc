#include "apps/scene/particles/motion.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &section, MotionFormulas &motion_formulas, const std::string &when)
  {
    declare_components(section, "Velocity", motion_formulas.velocity, "m/s", when);
    declare_components(section, "Spin", motion_formulas.spin, "rad/s",
                       when + ". Of each particle about its own centre");
  }

  void declare(Section &section, PrescribedFormulas &prescribed)
  {
    declare(section, static_cast<MotionFormulas &>(prescribed),
            "Prescribed, by the place x, y, z of each particle and time t; empty: free");
    declare_components(section, "Turn", prescribed.turn, "rad/s",
                       "Of the group as a rigid body about Centre, by time t; empty: none. Velocity is then that of "
                       "Centre, by time t");
    section.vector("Centre", prescribed.centre, "m", Range(), Need::optional)
      .notes(prescribed.centre_given)
      .means("That the group turns about; moves with Velocity")
      .only_if([&prescribed] { return prescribed.turns(); }, "Turn x, Turn y or Turn z is given");
  }

  void declare(Section &root, PrescribedMotionSection &prescribed_motion)
  {
    root.section("Motion", "One sub-section per group whose motion is prescribed, named after the group")
      .named_list("GROUP", prescribed_motion.motions, &PrescribedFormulas::group);
  }
} // namespace apps
