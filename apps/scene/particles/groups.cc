#include "apps/scene/particles/groups.h"

#include "apps/scene/entries/region.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &s, GroupSection &group)
  {
    using Members = GroupSection::Members;
    const auto by = [&group](const Members wanted) { return [&group, wanted] { return group.members == wanted; }; };
    s.choice("Members", group.members,
             {{"region", Members::region}, {"layer", Members::layer}, {"file", Members::file}}, Need::optional)
      .means("region: particles whose centre lies in it; layer: those near the outermost centre along an axis; file: "
             "those whose numbers it lists");
    declare(s, group.region, by(Members::region), "Members = region");
    s.choice("Axis", group.axis, {{"x", 0}, {"y", 1}, {"z", 2}}, Need::optional)
      .means("Across which the layer lies")
      .only_if(by(Members::layer), "Members = layer");
    s.choice("Side", group.high, {{"low", false}, {"high", true}}, Need::optional)
      .means("End of the axis, of the least or of the largest coordinates")
      .only_if(by(Members::layer), "Members = layer");
    s.number("Thickness", group.thickness, "m", Range::positive(), Need::required)
      .means("The layer holds the centres within it of the outermost centre")
      .only_if(by(Members::layer), "Members = layer");
    s.file("File", group.file)
      .means("Text with numbers of particles, counted from 1; from the scene's folder")
      .only_if(by(Members::file), "Members = file");
  }

  void declare(Section &root, GroupsSection &groups)
  {
    root.section("Groups", "One sub-section per group of particles; the group \"all\" is always there")
      .named_list("GROUP", groups.groups, &GroupSection::name);
  }
} // namespace apps
