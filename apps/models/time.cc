#include "apps/models/time.h"

#include "base/errors.h"

#include <fmt/format.h>

namespace apps
{
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
