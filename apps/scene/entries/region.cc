#include "apps/scene/entries/region.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &section, Region &region, const std::function<bool()> &requested, const std::string &words)
  {
    using Shape     = Region::Shape;
    const auto when = [&](Entry &entry, const std::function<bool()> &holds, const std::string &shapes) {
      entry.only_if([requested, holds] { return (!requested || requested()) && holds(); },
                    (words.empty() ? "" : words + " and ") + "Shape = " + shapes);
    };
    const auto is = [&region](const Shape wanted) { return [&region, wanted] { return region.shape == wanted; }; };
    const auto is_round = [&region] { return region.shape != Shape::box; };

    Entry &chosen =
      section
        .choice("Shape", region.shape, {{"box", Shape::box}, {"sphere", Shape::sphere}, {"cylinder", Shape::cylinder}},
                Need::optional)
        .means("box: along the axes, between two corners; sphere: about a centre; cylinder: about an axis between two "
               "places. In two dimensions a rectangle, circle or strip");
    if (requested)
      chosen.only_if(requested, words);
    when(section.vector("Lower", region.lower, "m", Range(), Need::required)
           .means("Corner of the box with the least coordinates"),
         is(Shape::box), "box");
    when(section.vector("Upper", region.upper, "m", Range(), Need::required)
           .means("Corner of the box with the largest coordinates"),
         is(Shape::box), "box");
    when(section.vector("Centre", region.centre, "m", Range(), Need::required).means("Of the sphere"),
         is(Shape::sphere), "sphere");
    when(
      section.vector("From", region.from, "m", Range(), Need::required).means("Where the axis of the cylinder begins"),
      is(Shape::cylinder), "cylinder");
    when(section.vector("To", region.to, "m", Range(), Need::required).means("Where the axis of the cylinder ends"),
         is(Shape::cylinder), "cylinder");
    when(section.number("Radius", region.radius, "m", Range::positive(), Need::required)
           .means("Of the sphere or cylinder"),
         is_round, "sphere or cylinder");
  }
} // namespace apps
