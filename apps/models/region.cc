#include "apps/models/region.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    using SpaceVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>; // of two or three coordinates

    SpaceVector coordinates(const std::array<double, 3> &of, const int dimension)
    {
      return Eigen::Map<const Eigen::Vector3d>(of.data()).head(dimension);
    }

    /** Of a straight line, from 0 at its start to 1 at its end, what is left inside a convex body. */
    class Stretch
    {
    public:
      bool empty() const { return begin > end; }

      /** Where low <= s rate <= high. */
      void between(const double low, const double high, const double rate)
      {
        if (rate == 0)
          return keep(low <= 0 && high >= 0 ? 0 : 2, 1);
        keep(std::min(low / rate, high / rate), std::max(low / rate, high / rate));
      }

      /** Where |off + s way| <= radius. */
      void within(const double radius, const SpaceVector &off, const SpaceVector &way)
      {
        const double a = way.squaredNorm(), b = way.dot(off), c = off.squaredNorm() - radius * radius;
        if (a == 0)
          return keep(c <= 0 ? 0 : 2, 1);
        const double square = b * b - a * c;
        if (square < 0)
          return keep(2, 1);
        keep((-b - std::sqrt(square)) / a, (-b + std::sqrt(square)) / a);
      }

    private:
      void keep(const double low, const double high)
      {
        begin = std::max(begin, low);
        end   = std::min(end, high);
      }

      double begin = 0, end = 1;
    };
  } // namespace

  void Region::check(const base::EntryPath &section, const int dimension) const
  {
    for (int d = 0; d < dimension && shape == Shape::box; ++d)
      if (!(lower[d] < upper[d]))
        section.refuse("Upper", "each coordinate must be above that of Lower.");
    if (shape == Shape::cylinder && coordinates(from, dimension) == coordinates(to, dimension))
      section.refuse("To", "is the same place as From: the cylinder has no length.");
  }

  bool Region::holds(const Eigen::Vector3d &place, const int dimension) const
  {
    const SpaceVector here = place.head(dimension);
    switch (shape)
      {
      case Shape::box:
        return (here.array() >= coordinates(lower, dimension).array()).all() &&
               (here.array() <= coordinates(upper, dimension).array()).all();
      case Shape::sphere:
        return (here - coordinates(centre, dimension)).squaredNorm() <= radius * radius;
      default:
        const SpaceVector start = coordinates(from, dimension), axis = coordinates(to, dimension) - start;
        const SpaceVector way  = here - start;
        const double      part = way.dot(axis) / axis.squaredNorm();
        return part >= 0 && part <= 1 && (way - part * axis).squaredNorm() <= radius * radius;
      }
  }

  bool Region::meets(const Eigen::Vector3d &one, const Eigen::Vector3d &other, const int dimension) const
  {
    const SpaceVector start = one.head(dimension), way = (other - one).head(dimension);
    Stretch           inside;
    switch (shape)
      {
      case Shape::box:
        for (int d = 0; d < dimension; ++d)
          inside.between(lower[d] - start[d], upper[d] - start[d], way[d]);
        break;
      case Shape::sphere:
        inside.within(radius, start - coordinates(centre, dimension), way);
        break;
      default:
        const SpaceVector foot = coordinates(from, dimension), axis = coordinates(to, dimension) - foot;
        const SpaceVector off    = start - foot;
        const double      length = axis.squaredNorm();
        inside.between(-off.dot(axis), length - off.dot(axis), way.dot(axis));
        inside.within(radius, off - off.dot(axis) / length * axis, way - way.dot(axis) / length * axis);
      }
    return !inside.empty();
  }
} // namespace apps
