#include "dem/facets/footprint.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    using Point = Eigen::Vector2d;

    /** Facets that lean from the tangential plane by less than 20 degrees are under the sphere, by more than 40 they are not. */
    const double upright = std::cos(20 * 3.14159265358979323846 / 180),
                 leaning = std::cos(40 * 3.14159265358979323846 / 180);
    /** What is left of a cell fades into a point below this part of the square around the sphere. */
    constexpr double smallest_part = 0.25;
    /** Areas that differ by less than this part of a cell are equal. */
    constexpr double rounding = 1e-10;
    /** Half a cell, at most, over the radius: it holds that of a square layer, whose corners are at the root of two. */
    constexpr double widest_cell = 1.42, widest_corner = 1.54;
    /** Spheres whose bound is this near are side by side, further away alone, over the radius; so many make a layer: those of its corners. */
    constexpr double side_by_side = 1.1, apart_from_others = 1.3, neighbours_of_a_layer = 2;
    /** Corners of a cell, at most; parts of facets in it, and what two of them share, have some more. */
    constexpr int corners_of_cell = 24, corners_of_part = 2 * corners_of_cell;

    /** Convex, turning left. */
    struct Polygon
    {
      std::array<Point, corners_of_part> corner;
      int                                count = 0;

      Polygon() = default;
      Polygon(const Polygon &other)
        : count(other.count)
      {
        std::copy_n(other.corner.begin(), count, corner.begin());
      }
      Polygon &operator=(const Polygon &other)
      {
        count = other.count;
        std::copy_n(other.corner.begin(), count, corner.begin());
        return *this;
      }

      /** Beyond what there is room for are only corners that rounding makes. */
      void add(const Point &p)
      {
        if (count < corners_of_part)
          corner[static_cast<std::size_t>(count++)] = p;
      }
      const Point &at(const int k) const { return corner[static_cast<std::size_t>(k % count)]; }
    };

    double turn(const Point &a, const Point &b) { return a.x() * b.y() - a.y() * b.x(); }

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

    /** Area and its first moment. */
    struct Area
    {
      double size   = 0;
      Point  moment = Point::Zero();
    };

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

    /** The tangential plane: its sides as nearly along the axes as the surface lets them be; in the plane z is one of them. */
    struct Tangents
    {
      Tangents(const Vector3d &origin_, const Vector3d &across, const bool in_the_plane)
        : origin(origin_)
      {
        Eigen::Index least = 0;
        across.cwiseAbs().minCoeff(&least);
        const Vector3d axis = in_the_plane ? Vector3d::UnitZ() : Vector3d::Unit(least);
        second              = in_the_plane ? axis : Vector3d((axis - across.dot(axis) * across).normalized());
        first               = second.cross(across);
      }
      Point of(const Vector3d &x) const { return {first.dot(x - origin), second.dot(x - origin)}; }

      Vector3d origin, first, second;
    };

    /** A facet seen in the tangential plane. In the plane segments become strips as wide as the sphere. */
    struct Facet
    {
      Facet(const FacetMesh             &mesh,
            const std::vector<Vector3d> &place,
            const std::int32_t           number_,
            const Tangents              &tangents,
            const double                 half)
        : number(number_)
        , corners(mesh.corners)
      {
        for (int c = 0; c < corners; ++c)
          {
            x[c]      = place[static_cast<std::size_t>(mesh.facet[static_cast<std::size_t>(number)][c])];
            corner[c] = tangents.of(x[c]);
          }
        if (corners == 3)
          outline.count = 3, outline.corner[0] = corner[0], outline.corner[1] = corner[1],
          outline.corner[2] = corner[2];
        else
          for (const auto &[end, side] : {std::pair(0, -half), {1, -half}, {1, half}, {0, half}})
            outline.add({corner[end].x(), side});
        size = area_of(outline).size;
        if (size < 0)
          std::reverse(outline.corner.begin(), outline.corner.begin() + outline.count);
      }

      /** Unit; of any sign. */
      Vector3d normal() const
      {
        const Vector3d edge = x[1] - x[0];
        return (corners == 3 ? edge.cross(Vector3d(x[2] - x[0])) : Vector3d(-edge.y(), edge.x(), 0)).normalized();
      }

      /** Shape functions there. */
      std::array<double, 3> shape(const Point &p) const
      {
        if (corners == 2)
          {
            const double along = (p.x() - corner[0].x()) / (corner[1].x() - corner[0].x());
            return {1 - along, along, 0};
          }
        const double b = turn(p - corner[0], corner[2] - corner[0]) / (2 * size),
                     c = turn(corner[1] - corner[0], p - corner[0]) / (2 * size);
        return {1 - b - c, b, c};
      }

      std::int32_t            number;
      int                     corners;
      std::array<Vector3d, 3> x;
      std::array<Point, 3>    corner;
      Polygon                 outline;
      double                  size; ///< signed
    };

    /** What of a facet is in the cell. */
    struct Covered
    {
      Facet   facet;
      Polygon part;
      double  share; ///< 1: upright, 0: leans too much
      Area    counted;
    };

    double share_of(const Facet &facet, const Vector3d &across)
    {
      return std::clamp((std::fabs(facet.normal().dot(across)) - leaning) / (upright - leaning), 0.0, 1.0);
    }

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
    std::vector<Bound> bounds_of(const std::vector<StandingSphere> &spheres,
                                 const ContactZone                 &zone,
                                 const Tangents                    &tangents,
                                 const double                       out)
    {
      std::vector<Bound>    found;
      const StandingSphere &own = spheres.front();
      for (std::size_t k = 1; k < spheres.size(); ++k)
        {
          const StandingSphere &other  = spheres[k];
          const double          stands = standing(own, other, zone.direction.dot(zone.place - other.centre));
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

    /** As symmetric about the contact as a layer is about each of its spheres. */
    Polygon cell_of(const std::vector<StandingSphere> &spheres,
                    const ContactZone                 &zone,
                    const Tangents                    &tangents,
                    const bool                         in_the_plane)
    {
      const double             radius = spheres.front().radius, diagonal = widest_cell * radius;
      const std::vector<Bound> bounds  = bounds_of(spheres, zone, tangents, widest_corner * radius);
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

    /** By the sides of another; those that rounding has left have no direction. */
    void cut(Polygon &polygon, const Polygon &by)
    {
      double size = 0;
      for (int k = 0; k < by.count; ++k)
        size = std::max(size, by.at(k).squaredNorm());
      for (int k = 0; k < by.count && polygon.count > 0; ++k)
        if ((by.at(k + 1) - by.at(k)).squaredNorm() > rounding * rounding * size)
          cut(polygon, by.at(k), by.at(k + 1));
    }

    /** Whether all of the cell lies in the facet. */
    bool holds(const Facet &facet, const Polygon &cell)
    {
      for (int s = 0; s < cell.count; ++s)
        for (int k = 0; k < facet.outline.count; ++k)
          {
            const Point &a = facet.outline.at(k), &b = facet.outline.at(k + 1);
            if (turn(b - a, cell.at(s) - a) < 0)
              return false;
          }
      return true;
    }

    /** Count what has its like on the other side of the contact. */
    void count_symmetric(std::vector<Covered> &under)
    {
      for (Covered &one : under)
        for (const Covered &other : under)
          {
            Polygon mirrored = other.part; // turned by half a circle: still turning left
            for (Point &p : mirrored.corner)
              p = -p;
            Polygon common = one.part;
            cut(common, mirrored);
            const Area   both   = area_of(common);
            const double weight = one.share * other.share;
            one.counted.size += weight * both.size;
            one.counted.moment += weight * both.moment;
          }
    }

    /** Where a sphere stands, and its cell. */
    struct Ground
    {
      Ground(const FacetMesh                   &mesh_,
             const std::vector<Vector3d>       &place_,
             const ContactZone                 &zone_,
             const std::vector<StandingSphere> &spheres)
        : mesh(mesh_)
        , place(place_)
        , zone(zone_)
        , tangents(zone_.place, zone_.direction, mesh_.corners == 2)
        , half(spheres.front().radius)
        , cell(cell_of(spheres, zone, tangents, mesh_.corners == 2))
      {
      }
      Facet  facet(const std::int32_t number) const { return {mesh, place, number, tangents, half}; }
      double share(const Facet &of) const { return share_of(of, zone.direction); }
      double square() const { return 4 * half * half; } ///< around the sphere [m^2]

      const FacetMesh             &mesh;
      const std::vector<Vector3d> &place;
      const ContactZone           &zone;
      Tangents                     tangents;
      double                       half;
      Polygon                      cell;
    };

    bool stands_on_one(const Ground &ground)
    {
      const Facet deepest = ground.facet(ground.zone.facet);
      return ground.zone.parts.size() == 1 && ground.share(deepest) == 1 && holds(deepest, ground.cell);
    }

    /**
     * What of the facets is in the cell, from facet to facet over shared corners: what lies behind a plate is not under the sphere.
     * @param each_around (facet, use): calls use(other) for those that share a corner with it
     */
    template <typename EachAround>
    std::vector<Covered> covered(const Ground &ground, const EachAround &each_around)
    {
      std::vector<Covered>      under;
      std::vector<std::int32_t> seen{ground.zone.facet}, open{ground.zone.facet};
      while (!open.empty())
        {
          const Facet facet = ground.facet(open.back());
          open.pop_back();
          const double share = ground.share(facet);
          Polygon      part  = facet.outline;
          if (share > 0)
            cut(part, ground.cell);
          const Area inside = share > 0 ? area_of(part) : Area();
          if (inside.size > 0)
            under.push_back({facet, part, share, inside});
          else if (facet.number != ground.zone.facet)
            continue;
          each_around(facet.number, [&](const std::int32_t other) {
            const auto at = std::lower_bound(seen.begin(), seen.end(), other);
            if (at != seen.end() && *at == other)
              return;
            seen.insert(at, other);
            open.push_back(other);
          });
        }
      return under;
    }

    double counted_area(const std::vector<Covered> &under)
    {
      double area = 0;
      for (const Covered &each : under)
        area += each.counted.size;
      return area;
    }

    /** @return what counts of the cell: all of it inside a surface, what is symmetric elsewhere */
    double count(std::vector<Covered> &under, const double whole)
    {
      const double area        = counted_area(under);
      const bool   all_upright = std::all_of(under.begin(), under.end(), [](const Covered &c) { return c.share == 1; });
      if (all_upright && area >= (1 - rounding) * whole)
        return area;
      for (Covered &each : under)
        each.counted = {};
      count_symmetric(under);
      return counted_area(under);
    }

    /** Axes that turn with a facet. */
    Eigen::Matrix3d axes_of(const FacetMesh &mesh, const std::vector<Vector3d> &place, const std::int32_t facet)
    {
      const auto corner = [&](const std::size_t c) -> const Vector3d & {
        return place[static_cast<std::size_t>(mesh.facet[static_cast<std::size_t>(facet)][c])];
      };
      Eigen::Matrix3d axes;
      axes.col(0) = (corner(1) - corner(0)).normalized();
      axes.col(2) = mesh.corners == 3 ? Vector3d(axes.col(0).cross(Vector3d(corner(2) - corner(0))).normalized()) :
                                        Vector3d::UnitZ();
      axes.col(1) = axes.col(2).cross(axes.col(0));
      return axes;
    }

    void add(std::vector<VertexWeight> &weights, const std::int32_t vertex, const double weight)
    {
      for (VertexWeight &known : weights)
        if (known.vertex == vertex)
          {
            known.weight += weight;
            return;
          }
      weights.push_back({vertex, weight});
    }

    /** Weights of the vertices under the cell. @param spread part of the whole */
    void add_spread(std::vector<VertexWeight>  &weights,
                    const FacetMesh            &mesh,
                    const std::vector<Covered> &under,
                    const double                spread,
                    const double                area)
    {
      for (const Covered &each : under)
        if (each.counted.size > 0)
          {
            const auto shape = each.facet.shape(each.counted.moment / each.counted.size);
            for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
              add(weights, mesh.facet[static_cast<std::size_t>(each.facet.number)][c],
                  spread * each.counted.size / area * shape[c]);
          }
    }

    /** What is not spread stays at the point of the contact. @return where that was in the undeformed surface */
    Vector3d
    add_point(std::vector<VertexWeight> &weights, const FacetMesh &mesh, const ContactZone &zone, const double spread)
    {
      Vector3d then = Vector3d::Zero();
      for (const ContactZone::Part &part : zone.parts)
        for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
          if (part.weight[c] != 0)
            {
              const std::int32_t vertex = mesh.facet[static_cast<std::size_t>(part.facet)][c];
              then += part.weight[c] * mesh.vertex[static_cast<std::size_t>(vertex)];
              if (spread < 1)
                add(weights, vertex, (1 - spread) * part.weight[c]);
            }
      return then;
    }

    Vector3d mean(const std::vector<VertexWeight> &weights, const std::vector<Vector3d> &place)
    {
      Vector3d sum = Vector3d::Zero();
      for (const VertexWeight &each : weights)
        sum += each.weight * place[static_cast<std::size_t>(each.vertex)];
      return sum;
    }
  } // namespace

  Footprint::Footprint(const FacetMesh &mesh)
    : from(mesh.vertex.size() + 1, 0)
  {
    const auto corners = static_cast<std::size_t>(mesh.corners);
    for (const auto &facet : mesh.facet)
      for (std::size_t c = 0; c < corners; ++c)
        ++from[static_cast<std::size_t>(facet[c]) + 1];
    for (std::size_t v = 1; v < from.size(); ++v)
      from[v] += from[v - 1];
    std::vector<std::size_t> next(from.begin(), from.end() - 1);
    around.resize(from.back());
    for (std::size_t f = 0; f < mesh.size(); ++f)
      for (std::size_t c = 0; c < corners; ++c)
        around[next[static_cast<std::size_t>(mesh.facet[f][c])]++] = static_cast<std::int32_t>(f);
  }

  bool Footprint::spread(const FacetMesh                   &mesh,
                         const std::vector<Vector3d>       &place,
                         const ContactZone                 &zone,
                         const std::vector<StandingSphere> &spheres,
                         SpreadContact                     &found) const
  {
    const Ground ground(mesh, place, zone, spheres);
    if (stands_on_one(ground))
      return false;
    std::vector<Covered> under = covered(ground, [&](const std::int32_t facet, const auto &use) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
        {
          const auto vertex = static_cast<std::size_t>(mesh.facet[static_cast<std::size_t>(facet)][c]);
          for (std::size_t k = from[vertex]; k < from[vertex + 1]; ++k)
            use(around[k]);
        }
    });
    const double area = count(under, area_of(ground.cell).size),
                 spread        = std::min(area / (smallest_part * ground.square()), 1.0);
    found.weights.clear();
    add_spread(found.weights, mesh, under, spread, area);
    const Vector3d point_then = add_point(found.weights, mesh, zone, spread);
    found.place               = mean(found.weights, place);
    // Heights of the mean surface above the point of the contact: what it was in the undeformed surface is its shape.
    const Vector3d mean_then = mean(found.weights, mesh.vertex);
    const Vector3d across_then =
      axes_of(mesh, mesh.vertex, zone.facet) * axes_of(mesh, place, zone.facet).transpose() * zone.direction;
    found.overlap =
      zone.overlap - zone.direction.dot(found.place - zone.place) + across_then.dot(mean_then - point_then);
    return true;
  }
} // namespace dem
