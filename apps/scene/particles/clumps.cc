#include "apps/scene/particles/clumps.h"

#include "apps/scene/number_list.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, ClumpsSection &clumps)
  {
    root
      .section("Clumps",
               "One sub-section per group whose particles move as one rigid body, named after the group: they "
               "keep their distances, and neither bonds nor contacts are between them")
      .named_list("GROUP", clumps.clumps, &ClumpSection::group, [](Section &opened, ClumpSection &added) {
        declare_list(
          opened, "Corners", [&added](const std::string &text) { added.corners = corners_in_text(text); }, "m",
          Need::optional)
          .means(
            "Of a convex polyhedron, in two dimensions a polygon, that the particles stand for [m]: coordinates "
            "between "
            "commas, corners between semicolons, those of a polygon in their order. Mass, centre and inertia are then "
            "those of the shape, with the density of the group's first particle; empty: those of the particles "
            "together");
        opened.choice("Pebbles", added.inside, {{"group", false}, {"inside", true}}, Need::optional)
          .means(
            "group: all particles of the group of this name; inside: all whose centre lies in the shape, a new group "
            "of this name")
          .only_if([&added] { return added.has_shape(); }, "Corners is given");
        opened.number("Mass", added.mass, "kg", Range::at_least(0), Need::optional)
          .means("Of the body; 0: that of the shape, or of its particles together, overlaps counted twice");
        opened.number("Inertia", added.inertia, "kg m^2", Range::at_least(0), Need::optional)
          .means(
            "About its centre, in two dimensions; 0: that of the shape or of its particles together, in proportion to "
            "the mass");
      });
  }
} // namespace apps
