#include "dem/facets/ground.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dem::cells
{
  using Eigen::Vector3d;

  const double upright = std::cos(20 * 3.14159265358979323846 / 180),
               leaning = std::cos(40 * 3.14159265358979323846 / 180);

  bool holds(const Facet &facet, const Point &p)
  {
    constexpr double on_side = 1e-12; // to rounding
    for (int k = 0; k < facet.outline.count; ++k)
      {
        const Point &a = facet.outline.at(k), &b = facet.outline.at(k + 1);
        if (turn(b - a, p - a) < -on_side * (b - a).squaredNorm())
          return false;
      }
    return true;
  }

  namespace
  {
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

    double counted_area(const std::vector<Covered> &under)
    {
      double area = 0;
      for (const Covered &each : under)
        area += each.counted.size;
      return area;
    }
  } // namespace

  double Ground::share(const Facet &of) const
  {
    return std::clamp((std::fabs(of.normal().dot(tangents.across)) - leaning) / (upright - leaning), 0.0, 1.0);
  }

  bool Ground::lies_in(const std::int32_t number) const
  {
    const Facet only = facet(number);
    return share(only) == 1 && std::all_of(cell.corner.begin(), cell.corner.begin() + cell.count,
                                           [&](const Point &p) { return holds(only, p); });
  }

  std::vector<Covered> Ground::covered(const FacetsAround &around, const std::int32_t from) const
  {
    std::vector<Covered>      under;
    std::vector<std::int32_t> seen{from}, open{from};
    while (!open.empty())
      {
        const Facet facet = this->facet(open.back());
        open.pop_back();
        const double share = this->share(facet);
        Polygon      part  = facet.outline;
        if (share > 0)
          cut(part, cell);
        const Area inside = share > 0 ? area_of(part) : Area();
        if (inside.size > 0)
          under.push_back({facet, part, share, inside});
        else if (facet.number != from)
          continue;
        around.each(mesh, facet.number, [&](const std::int32_t other) {
          const auto at = std::lower_bound(seen.begin(), seen.end(), other);
          if (at != seen.end() && *at == other)
            return;
          seen.insert(at, other);
          open.push_back(other);
        });
      }
    return under;
  }

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
} // namespace dem::cells
