#include "dem/genesis/vessel.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <cmath>

namespace dem
{
  void Vessel::check() const
  {
    for (int d = 0; d < dimension; ++d)
      if (!(size[d] > 0 && std::isfinite(size[d])))
        throw base::InputError("Vessel: size = " + base::number_text(size[d]) + " m: must be above 0.");
    if (shape == Shape::box)
      return;
    if (dimension == 2)
      throw base::InputError("Vessel: a cylinder has three dimensions; in the plane it is a box.");
    if (size[0] != size[1])
      throw base::InputError("Vessel: a cylinder is as wide along x (" + base::number_text(size[0]) +
                             " m) as along y (" + base::number_text(size[1]) + " m): its diameter.");
  }

  double Vessel::space() const
  {
    if (shape == Shape::cylinder)
      return M_PI / 4 * size[0] * size[0] * size[2];
    return dimension == 2 ? size[0] * size[1] : size.prod();
  }

  WallTouches Vessel::near(const Eigen::Vector3d &centre, const double radius, const double margin) const
  {
    WallTouches found;
    const auto  add = [&](const double gap, const Eigen::Vector3d &inward) {
      if (gap < margin)
        found.touch[static_cast<std::size_t>(found.count++)] = {gap, inward};
    };
    const int first_plane = shape == Shape::cylinder ? 2 : 0;
    if (shape == Shape::cylinder)
      {
        const double          half = 0.5 * size[0];
        const Eigen::Vector3d out(centre[0] - half, centre[1] - half, 0);
        const double          distance = out.norm();
        if (distance > 0)
          add(half - distance - radius, -out / distance);
      }
    for (int d = first_plane; d < dimension; ++d)
      {
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(d);
        add(centre[d] - radius, axis);
        add(size[d] - centre[d] - radius, -axis);
      }
    return found;
  }

  Eigen::Vector3d Vessel::place(const std::array<double, 3> &random, const double radius) const
  {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int d = 0; d < dimension; ++d)
      x[d] = radius + random[static_cast<std::size_t>(d)] * (size[d] - 2 * radius);
    if (shape == Shape::box)
      return x;
    const double half = 0.5 * size[0], r = (half - radius) * std::sqrt(random[0]), angle = 2 * M_PI * random[1];
    x[0] = half + r * std::cos(angle);
    x[1] = half + r * std::sin(angle);
    return x;
  }
} // namespace dem
