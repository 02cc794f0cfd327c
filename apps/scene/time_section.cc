#include "apps/scene/time_section.h"

namespace apps
{
  void TimeSection::declare(Section &root)
  {
    Section &section = root.section("Time", "How the motion is integrated");
    section.number("Step factor", step_factor, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
      .means("Time step over the stable step (least bound over all particles); 0.8 leaves a margin for new contacts");
    section.number("Damping", damping, "-", Range::from_up_to(0, 1), Need::optional)
      .means("Local (Cundall) damping D of the particles; 0.3 calms stress waves within a few crossings");
  }
} // namespace apps
