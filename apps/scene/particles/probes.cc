#include "apps/scene/particles/probes.h"

#include "apps/scene/particles/motion.h"
#include "apps/scene/particles/walls.h"
#include "apps/scene/section.h"

#include <cctype>

namespace apps
{
  void declare(Section &s, ProbeSection &probe)
  {
    using Quantity  = ProbeSection::Quantity;
    using Component = ProbeSection::Component;
    s.choice("Quantity", probe.quantity,
             {{"position", Quantity::position},
              {"displacement", Quantity::displacement},
              {"velocity", Quantity::velocity},
              {"spin", Quantity::spin},
              {"distance", Quantity::distance},
              {"reaction", Quantity::reaction},
              {"reaction moment", Quantity::reaction_moment},
              {"reaction torque", Quantity::reaction_torque},
              {"wall force", Quantity::wall_force},
              {"wall moment", Quantity::wall_moment},
              {"wall travel", Quantity::wall_travel},
              {"wall impulse", Quantity::wall_impulse},
              {"force", Quantity::force},
              {"kinetic energy", Quantity::kinetic_energy},
              {"broken links", Quantity::broken_links},
              {"unbalanced ratio", Quantity::unbalanced_ratio}},
             Need::required)
      .means(
        "position, displacement, velocity: of the centre of mass of the group; spin: mean of its particles (and rigid "
        "bodies) by mass; distance: from it to that of the "
        "other group; reaction: force that the prescribed motion exerts on the group; reaction moment: sum of its "
        "moments on the particles about their own centres; reaction torque: moment of its forces and moments about "
        "Point; wall force, wall moment: of the particles on the wall, the moment about Point; wall travel: of the "
        "wall since the start; wall impulse: momentum that it has taken; force: of "
        "links, contacts and walls on the group, from all that is not of it; kinetic "
        "energy: of the group; broken links: that have "
        "an end in it; unbalanced ratio: mean force on all free particles over mean force of links and contacts");
    s.text("Group", probe.group, Need::optional).means("What is measured");
    s.text("Wall", probe.wall, Need::required)
      .means("Of section Walls")
      .only_if([&probe] { return probe.of_wall(); }, "Quantity is of a wall");
    s.vector("Point", probe.point, "m", Range(), Need::optional)
      .means("About which the moment is taken; it stays where it is. In two dimensions z is 0")
      .only_if(
        [&probe] { return probe.quantity == Quantity::reaction_torque || probe.quantity == Quantity::wall_moment; },
        "Quantity is reaction torque or wall moment");
    s.text("Other group", probe.other, Need::required)
      .means("To which the distance is measured")
      .only_if([&probe] { return probe.quantity == Quantity::distance; }, "Quantity = distance");
    s.choice("Component", probe.component,
             {{"x", Component::x}, {"y", Component::y}, {"z", Component::z}, {"size", Component::size}}, Need::optional)
      .means("Of a vector; size: its length")
      .only_if([&probe] { return probe.is_vector(); }, "Quantity is a vector");
  }

  void declare(Section &root, ProbesSection &probes)
  {
    root.section("Probes", "One sub-section per number that is measured; its name is that of a column of series.csv")
      .named_list("PROBE", probes.probes, &ProbeSection::name);
  }
} // namespace apps
