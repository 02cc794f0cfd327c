#include "apps/scene/time_section.h"

#include "base/errors.h"

#include <fmt/format.h>

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

  void TimeSection::declare_by_time(Section &root)
  {
    root.find_section("Time")
      ->expression("Damping in time", damping_in_time, "-")
      .means("The same by time t, in [0, 1): little while things move, more to come to rest, as t < 0.8 ? 0.1 : 0.7; "
             "empty: Damping throughout");
  }

  void TimeSection::check_by_time(const base::EntryPath &root) const
  {
    const base::EntryPath section = root.at("Time");
    if (damping_in_time.varies_in_space())
      section.refuse("Damping in time", "all particles have the same damping: a formula of t alone.");
    damping_at(0);
  }

  double TimeSection::damping_at(const double time) const
  {
    if (!damping_in_time.given())
      return damping;
    const double now = damping_in_time(0, 0, 0, time);
    if (!(now >= 0 && now < 1))
      throw base::InputError(
        fmt::format("Time/Damping in time = {} at t = {:.6g} s: damping lies in [0, 1).", now, time));
    return now;
  }
} // namespace apps
