#include "apps/scene/structure/probes.h"

#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, DisplacementProbesSection &displacement_probes)
  {
    root
      .section("Probes",
               "One sub-section per displacement of particles that is recorded; its name is the column of series.csv")
      .named_list(
        "PROBE", displacement_probes.probes, &DisplacementProbe::name, [](Section &opened, DisplacementProbe &added) {
          opened.text("Group", added.group, Need::optional).means("Of particles whose mean displacement is measured");
          opened.text("Other group", added.other, Need::optional)
            .means("From which it is measured, as the opening of a notch is; empty: from where it was");
          opened.choice("Component", added.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::required)
            .means("Of the displacement");
        });
  }
} // namespace apps
