#include "apps/models/start_velocity.h"

namespace apps
{
  void refuse_time(const base::EntryPath &section, const std::string &quantity, const Expressions &velocity)
  {
    for (std::size_t c = 0; c < 3; ++c)
      if (velocity[c].varies_in_time())
        section.refuse(quantity + (quantity.empty() ? "" : " ") + "xyz"[c],
                       "is taken once, at the start: a number, or a formula of x, y and z. A table, as a formula of t, "
                       "is over time.");
  }
} // namespace apps
