#include "apps/scene/entries/gravity.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare_dead_weight(Section &root, GravitySection &gravity, const char *const meaning)
  {
    root.section("Gravity", meaning)
      .vector("Acceleration", gravity.acceleration, "m/s^2", Range(), Need::optional)
      .means("Of what falls; 0, 0, -9.81 on earth with z upwards");
  }

  void declare(Section &root, GravitySection &gravity, const char *const meaning)
  {
    using Start = GravitySection::Start;
    declare_dead_weight(root, gravity, meaning);
    Section &section = *root.find_section("Gravity");
    section
      .choice("Initial equilibrium", gravity.start, {{"none", Start::none}, {"static", Start::statics}}, Need::optional)
      .means("static: before the first step the particles move to where links and weight are in equilibrium, grips and "
             "supports held; none: the weight acts suddenly");
  }
} // namespace apps
