#include "dem/facets/cell.h"

#include <cmath>
#include <tuple>

namespace dem::cells
{
  using Eigen::Vector3d;

  /** Keep what lies to the left of the way from a to b. */
  void cut(Polygon &polygon, const Point &a, const Point &b)
  {
    const auto left = [&](const Point &p) { return turn(b - a, p - a); };
    if (std::all_of(polygon.corner.begin(), polygon.corner.begin() + polygon.count,
                    [&](const Point &p) { return left(p) >= 0; }))
      return;
    Polygon kept;
    for (int k = 0; k < polygon.count; ++k)
      {
        const Point &p = polygon.at(k), &next = polygon.at(k + 1);
        const double here = left(p), there = left(next);
        if (here >= 0)
          kept.add(p);
        if ((here > 0 && there < 0) || (here < 0 && there > 0))
          kept.add(p + here / (here - there) * (next - p));
      }
    polygon = kept;
  }

  void cut(Polygon &polygon, const Polygon &by)
  {
    double size = 0;
    for (int k = 0; k < by.count; ++k)
      size = std::max(size, by.at(k).squaredNorm());
    for (int k = 0; k < by.count && polygon.count > 0; ++k)
      if ((by.at(k + 1) - by.at(k)).squaredNorm() > rounding * rounding * size)
        cut(polygon, by.at(k), by.at(k + 1));
  }

  Area area_of(const Polygon &polygon)
  {
    Area sum;
    for (int k = 1; k + 1 < polygon.count; ++k)
      {
        const Point &a = polygon.at(0), &b = polygon.at(k), &c = polygon.at(k + 1);
        const double part = 0.5 * turn(b - a, c - a);
        sum.size += part;
        sum.moment += part / 3 * (a + b + c);
      }
    return sum;
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
      for (const Point &towards : {by.towards, Point(-by.towards)})
        if (polygon.count < corners_of_cell &&
            std::any_of(polygon.corner.begin(), polygon.corner.begin() + polygon.count,
                        [&](const Point &p) { return towards.dot(p) > limit; }))
          cut(polygon, by.distance * towards, by.distance * towards + Point(-towards.y(), towards.x()));
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
      cell.add(p);
    bound(cell, {diagonal, Point(1, 1).normalized(), 0});
    bound(cell, {diagonal, Point(1, -1).normalized(), 0});
    for (const Bound &each : bounds)
      bound(cell, each);
    return cell;
  }
} // namespace dem::cells
