#include "apps/scene/entries/time.h"

#include "apps/scene/section.h"
#include "base/errors.h"

namespace apps
{
  void declare(Section &root, TimeSection &time)
  {
    Section &section = root.section("Time", "How the motion is integrated");
    section
      .number("Step factor", time.step_factor, "-", {std::numeric_limits<double>::min(), 1.0, true}, Need::optional)
      .means("Time step over the stable step (least bound over all particles); 0.8 leaves a margin for new contacts");
    section.number("Damping", time.damping, "-", Range::from_up_to(0, 1), Need::optional)
      .means("Local (Cundall) damping D of the particles; 0.3 calms stress waves within a few crossings");
  }

  void declare_by_time(Section &root, TimeSection &time)
  {
    root.find_section("Time")
      ->expression("Damping in time", time.damping_in_time, "-")
      .means("The same by time t, in [0, 1): little while things move, more to come to rest, as t < 0.8 ? 0.1 : 0.7; "
             "empty: Damping throughout");
  }
} // namespace apps
