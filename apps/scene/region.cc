#include "apps/scene/region.h"

namespace apps
{
  void Region::declare(Section &section, const std::function<bool()> &asked, const std::string &words)
  {
    const auto when = [&](Entry &entry, const std::function<bool()> &holds, const std::string &shapes) {
      entry.only_if([asked, holds] { return (!asked || asked()) && holds(); },
                    (words.empty() ? "" : words + " and ") + "Shape = " + shapes);
    };
    const auto is       = [this](const Shape wanted) { return [this, wanted] { return shape == wanted; }; };
    const auto is_round = [this] { return shape != Shape::box; };

    Entry &chosen =
      section
        .choice("Shape", shape, {{"box", Shape::box}, {"sphere", Shape::sphere}, {"cylinder", Shape::cylinder}},
                Need::optional)
        .means("box: along the axes, between two corners; sphere: about a centre; cylinder: about an axis between two "
               "places. In two dimensions a rectangle, circle or strip");
    if (asked)
      chosen.only_if(asked, words);
    when(section.vector("Lower", lower, "m", Range(), Need::required)
           .means("Corner of the box with the least coordinates"),
         is(Shape::box), "box");
    when(section.vector("Upper", upper, "m", Range(), Need::required)
           .means("Corner of the box with the largest coordinates"),
         is(Shape::box), "box");
    when(section.vector("Centre", centre, "m", Range(), Need::required).means("Of the sphere"), is(Shape::sphere),
         "sphere");
    when(section.vector("From", from, "m", Range(), Need::required).means("Where the axis of the cylinder begins"),
         is(Shape::cylinder), "cylinder");
    when(section.vector("To", to, "m", Range(), Need::required).means("Where the axis of the cylinder ends"),
         is(Shape::cylinder), "cylinder");
    when(section.number("Radius", radius, "m", Range::positive(), Need::required).means("Of the sphere or cylinder"),
         is_round, "sphere or cylinder");
  }

  void Region::check(const base::EntryPath &section, const int dimension) const
  {
    for (int d = 0; d < dimension && shape == Shape::box; ++d)
      if (!(lower[d] < upper[d]))
        section.refuse("Upper", "each coordinate must be above that of Lower.");
    if (shape == Shape::cylinder && Eigen::Map<const Eigen::Vector3d>(from.data()).head(dimension) ==
                                      Eigen::Map<const Eigen::Vector3d>(to.data()).head(dimension))
      section.refuse("To", "is the same place as From: the cylinder has no length.");
  }

  bool Region::holds(const Eigen::Vector3d &place, const int dimension) const
  {
    using Coordinates   = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>; // of two or three coordinates
    const auto as_place = [dimension](const std::array<double, 3> &c) -> Coordinates {
      return Eigen::Map<const Eigen::Vector3d>(c.data()).head(dimension);
    };
    const Coordinates here = place.head(dimension);
    switch (shape)
      {
      case Shape::box:
        return (here.array() >= as_place(lower).array()).all() && (here.array() <= as_place(upper).array()).all();
      case Shape::sphere:
        return (here - as_place(centre)).squaredNorm() <= radius * radius;
      default:
        const Coordinates axis = as_place(to) - as_place(from), way = here - as_place(from);
        const double      part = way.dot(axis) / axis.squaredNorm();
        return part >= 0 && part <= 1 && (way - part * axis).squaredNorm() <= radius * radius;
      }
  }
} // namespace apps
