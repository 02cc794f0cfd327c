#include "apps/models/gravity.h"

namespace apps
{
  void GravitySection::check(const base::EntryPath &root, const int dimension) const
  {
    if (dimension == 2 && acceleration[2] != 0)
      root.at("Gravity").refuse("Acceleration", "in two dimensions it lies in the plane: its z must be 0.");
  }
} // namespace apps
