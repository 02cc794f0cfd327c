#include "apps/scene/entries/emission.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, EmissionSection &emission)
  {
    root.section("Emission", "Acoustic emission: what breaks, grouped to events with their magnitude and moment tensor")
      .number("Reach", emission.reach, "-", Range::between(0, 1000), Need::optional)
      .means("A bond that breaks this near to one of an event belongs to it, as long as the event lasts; in mean "
             "diameters of the particles. 0: not listened to; 2 is usual");
  }
} // namespace apps
