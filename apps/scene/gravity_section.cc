#include "apps/scene/gravity_section.h"

namespace apps
{
  void GravitySection::declare(Section &root, const char *const meaning)
  {
    Section &section = root.section("Gravity", meaning);
    section.vector("Acceleration", acceleration, "m/s^2", Range(), Need::optional)
      .means("Of what falls; 0, 0, -9.81 on earth with z upwards");
    section.choice("Initial equilibrium", start, {{"none", Start::none}, {"static", Start::statics}}, Need::optional)
      .means("static: before the first step the particles move to where links and weight are in equilibrium, grips and "
             "supports held; none: the weight acts suddenly");
  }

  void GravitySection::check(const base::EntryPath &root, const int dimension) const
  {
    if (dimension == 2 && acceleration[2] != 0)
      root.at("Gravity").refuse("Acceleration", "in two dimensions it lies in the plane: its z must be 0.");
  }
} // namespace apps
