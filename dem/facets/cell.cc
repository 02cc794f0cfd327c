#include "dem/facets/cell.h"

#include <cmath>
#include <tuple>

namespace dem::cells
{
  void cut(Polygon &polygon, const HalfPlane &by, const Side kind)
  {
    const auto                          count = static_cast<std::size_t>(polygon.count);
    std::array<double, corners_of_part> height;
    double                              least = 1, most = -1;
    for (std::size_t k = 0; k < count; ++k)
      {
        height[k] = by.at(polygon.corner[k]);
        least     = k == 0 ? height[k] : std::min(least, height[k]);
        most      = k == 0 ? height[k] : std::max(most, height[k]);
      }
    if (least >= 0)
      return;
    Polygon kept;
    for (std::size_t k = 0; k < count && most > 0; ++k)
      {
        const std::size_t n    = k + 1 < count ? k + 1 : 0;
        const double      here = height[k], there = height[n];
        const auto        crossing = [&] {
          return Point(polygon.corner[k] + here / (here - there) * (polygon.corner[n] - polygon.corner[k]));
        };
        if (here >= 0)
          kept.add(polygon.corner[k], here == 0 && there < 0 ? kind : polygon.side[k]);
        if (here > 0 && there < 0)
          kept.add(crossing(), kind);
        else if (here < 0 && there > 0)
          kept.add(crossing(), polygon.side[k]);
      }
    polygon = kept;
  }

  Area area_of(const Polygon &polygon)
  {
    Area sum;
    for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(polygon.count); ++k)
      {
        const Point &a = polygon.corner[0], &b = polygon.corner[k], &c = polygon.corner[k + 1];
        const double part = 0.5 * turn(b - a, c - a);
        sum.size += part;
        sum.moment += part / 3 * (a + b + c);
      }
    return sum;
  }

  std::array<Area, 2> glide_of(const Polygon &polygon)
  {
    std::array<Area, 2> along;
    const auto          count = static_cast<std::size_t>(polygon.count);
    for (std::size_t k = 0; k < count; ++k)
      {
        if (polygon.side[k] == Side::surface)
          continue;
        const Point &from = polygon.corner[k], &to = polygon.corner[k + 1 < count ? k + 1 : 0];
        const double way = static_cast<double>(polygon.side[k]);
        // Length times the part of the outward normal along the axis.
        const std::array<double, 2> swept = {way * (to.y() - from.y()), way * (from.x() - to.x())};
        for (std::size_t d = 0; d < 2; ++d)
          along[d].add({1, 0.5 * (from + to)}, swept[d]);
      }
    return along;
  }

  namespace
  {
    /** Half a cell, at most, over the radius: it holds that of a square layer, whose corners are at the root of two. */
    constexpr double widest_cell = 1.42, widest_corner = 1.54;
    /** Spheres whose bound is this near are side by side, further away alone, over the radius; so many make a layer: those of its corners. */
    constexpr double side_by_side = 1.1, apart_from_others = 1.3, neighbours_of_a_layer = 2;

    /** Bounds a cell: beyond this distance, on both sides of the contact. */
    struct Bound
    {
      double distance; ///< [m]
      Point  towards;  ///< unit
      double crowds;   ///< how much it is side by side with the sphere, in [0, 1]

      bool operator<(const Bound &o) const
      {
        return std::make_tuple(distance, towards.x(), towards.y()) <
               std::make_tuple(o.distance, o.towards.x(), o.towards.y());
      }
    };

    /** One at a value and before it, nothing at another and beyond, even between. */
    double faded(const double value, const double whole, const double nothing)
    {
      return std::clamp((value - nothing) / (whole - nothing), 0.0, 1.0);
    }

    /** How much a sphere bounds the cell of another: wholly if it stands on the plane and is not much smaller. */
    double standing(const StandingSphere &own, const StandingSphere &other, const double height)
    {
      const double gap = height / other.radius - 1;
      return (gap > 0 ? faded(gap, 0, 0.5) : faded(-gap, 0.5, 1)) * faded(other.radius / own.radius, 0.5, 0.25);
    }

    /** Whatever bounds a cell of this size, the nearest first: others in the ratio of the radii. */
    std::vector<Bound> bounds_of(const std::vector<StandingSphere> &spheres, const Tangents &tangents, const double out)
    {
      std::vector<Bound>    found;
      const StandingSphere &own = spheres.front();
      for (std::size_t k = 1; k < spheres.size(); ++k)
        {
          const StandingSphere &other  = spheres[k];
          const double          stands = standing(own, other, tangents.across.dot(tangents.origin - other.centre));
          const Point           there  = tangents.of(other.centre);
          const double          apart = there.norm(), between = apart * own.radius / (own.radius + other.radius);
          if (stands > 0 && between > 0 && between < out)
            found.push_back({stands * between + (1 - stands) * out, there / apart,
                             stands * faded(between / own.radius, side_by_side, apart_from_others)});
        }
      std::sort(found.begin(), found.end());
      return found;
    }

    /** The part of a polygon within a distance from the origin, on both sides. */
    void bound(Polygon &polygon, const Bound &by)
    {
      // The same bound once more, as spheres opposite to each other have it, only makes corners by rounding.
      const double limit = by.distance * (1 + rounding);
      if (polygon.count + 2 <= corners_of_cell &&
          std::any_of(polygon.corner.begin(), polygon.corner.begin() + polygon.count,
                      [&](const Point &p) { return std::fabs(by.towards.dot(p)) > limit; }))
        for (const Point &towards : {by.towards, Point(-by.towards)})
          cut(polygon, {by.distance, -towards}, Side::cell);
    }
  } // namespace

  Polygon cell_of(const std::vector<StandingSphere> &spheres, const Tangents &tangents, const bool in_the_plane)
  {
    const double             radius = spheres.front().radius, diagonal = widest_cell * radius;
    const std::vector<Bound> bounds  = bounds_of(spheres, tangents, widest_corner * radius);
    double                   crowded = 0;
    for (const Bound &each : bounds)
      crowded += each.crowds;
    // Discs in the plane have no corners to fill.
    const double half =
      radius * (in_the_plane ? 1 : 1 + (widest_cell - 1) * std::min(crowded / neighbours_of_a_layer, 1.0));
    Polygon cell;
    for (const Point &p : {Point(-half, -half), Point(half, -half), Point(half, half), Point(-half, half)})
      cell.add(p, Side::cell);
    bound(cell, {diagonal, Point(1, 1).normalized(), 0});
    bound(cell, {diagonal, Point(1, -1).normalized(), 0});
    for (const Bound &each : bounds)
      bound(cell, each);
    return cell;
  }
} // namespace dem::cells
