#include "apps/scene/material_region.h"

namespace apps
{
  void MaterialRegion::declare(Section &section)
  {
    const auto is_box    = [this] { return shape == Shape::box; };
    const auto is_sphere = [this] { return shape == Shape::sphere; };
    section.text("Material", material, Need::required).means("Name of a section in Materials");
    section.choice("Shape", shape, {{"box", Shape::box}, {"sphere", Shape::sphere}}, Need::optional)
      .means(
        "box: along the axes, between two corners; sphere: about a centre. In two dimensions a rectangle or circle");
    section.vector("Lower", lower, "m", Range(), Need::required)
      .means("Corner of the box with the least coordinates")
      .only_if(is_box, "Shape = box");
    section.vector("Upper", upper, "m", Range(), Need::required)
      .means("Corner of the box with the largest coordinates")
      .only_if(is_box, "Shape = box");
    section.vector("Centre", centre, "m", Range(), Need::required)
      .means("Of the sphere")
      .only_if(is_sphere, "Shape = sphere");
    section.number("Radius", radius, "m", Range::positive(), Need::required)
      .means("Of the sphere")
      .only_if(is_sphere, "Shape = sphere");
  }

  void MaterialRegion::validate(const Section &section, const int dimension) const
  {
    for (int d = 0; d < dimension && shape == Shape::box; ++d)
      if (!(lower[d] < upper[d]))
        section.refuse("Upper", "each coordinate must be above that of Lower.");
  }

  bool MaterialRegion::holds(const Eigen::Vector3d &place, const int dimension) const
  {
    double squared = 0;
    for (int d = 0; d < dimension; ++d)
      {
        if (shape == Shape::box && (place[d] < lower[d] || place[d] > upper[d]))
          return false;
        squared += (place[d] - centre[d]) * (place[d] - centre[d]);
      }
    return shape == Shape::box || squared <= radius * radius;
  }
} // namespace apps
