#include "apps/models/region.h"

namespace apps
{
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
