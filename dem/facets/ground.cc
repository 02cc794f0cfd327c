#include "dem/facets/ground.h"

#include <Eigen/Geometry>

#include <cmath>

namespace dem::cells
{
  using Eigen::Vector3d;

  const double upright = std::cos(20 * 3.14159265358979323846 / 180),
               leaning = std::cos(40 * 3.14159265358979323846 / 180);

  Facet::Facet(const FacetMesh             &mesh,
               const std::vector<Vector3d> &place,
               const std::int32_t           number_,
               const Tangents              &tangents)
    : number(number_)
    , corners(mesh.corners)
  {
    std::array<Vector3d, 3> x;
    std::array<Point, 3>    p;
    for (std::size_t c = 0; c < static_cast<std::size_t>(corners); ++c)
      {
        x[c] = place[static_cast<std::size_t>(mesh.facet[static_cast<std::size_t>(number)][c])];
        p[c] = tangents.of(x[c]);
      }
    const double leans = std::fabs(facet_normal(x, corners == 2).dot(tangents.across));
    share              = std::clamp((leans - leaning) / (upright - leaning), 0.0, 1.0);
    if (share == 0)
      return; // upside down or on edge it may have no area here
    if (corners == 2)
      {
        const double along = p[1].x() - p[0].x();
        shape[0]           = {p[1].x() / along, {-1 / along, 0}};
        shape[1]           = {-p[0].x() / along, {1 / along, 0}};
        return;
      }
    const double twice = turn(p[1] - p[0], p[2] - p[0]);
    for (std::size_t c = 0; c < 3; ++c)
      {
        const Point &from = p[(c + 1) % 3], side = p[(c + 2) % 3] - from;
        shape[c] = {turn(from, side) / twice, Point(-side.y(), side.x()) / twice};
      }
  }

  bool Facet::holds(const Point &p) const
  {
    constexpr double on_side = -1e-12; // to rounding
    for (std::size_t c = 0; c < static_cast<std::size_t>(corners); ++c)
      if (shape[c].at(p) < on_side)
        return false;
    return true;
  }

  bool Facet::holds(const Polygon &cell) const
  {
    return std::all_of(cell.corner.begin(), cell.corner.begin() + cell.count, [&](const Point &p) { return holds(p); });
  }

  bool Cover::add(const Facet &facet, const Polygon &cell)
  {
    Polygon part = cell;
    facet.cut_out_of(part);
    const Area inside = area_of(part);
    if (!(inside.size > 0))
      return false;
    Covered &next = under.add();
    next.facet    = facet;
    next.part     = part;
    next.low = next.high = part.corner[0];
    for (std::size_t k = 1; k < static_cast<std::size_t>(part.count); ++k)
      {
        next.low  = next.low.cwiseMin(part.corner[k]);
        next.high = next.high.cwiseMax(part.corner[k]);
      }
    next.counted = inside;
    next.glide   = glide_of(part);
    return true;
  }

  void Cover::count_symmetric(const Point &about)
  {
    for (Covered &one : under)
      {
        one.counted = {};
        one.glide   = {};
      }
    for (const Covered &other : under)
      {
        std::array<HalfPlane, 3> mirrored;
        for (std::size_t c = 0; c < static_cast<std::size_t>(other.facet.corners); ++c)
          mirrored[c] = other.facet.shape[c].mirrored(about);
        const Point low = 2 * about - other.high, high = 2 * about - other.low;
        for (Covered &one : under)
          {
            if ((one.high.array() <= low.array()).any() || (one.low.array() >= high.array()).any())
              continue;
            Polygon common = one.part;
            for (std::size_t c = 0; c < static_cast<std::size_t>(other.facet.corners) && common.count > 0; ++c)
              cut(common, mirrored[c], Side::mirrored);
            const double weight = one.facet.share * other.facet.share;
            one.counted.add(area_of(common), weight);
            const auto glide = glide_of(common);
            for (std::size_t d = 0; d < 2; ++d)
              one.glide[d].add(glide[d], weight);
          }
      }
  }

  double Cover::count(const double whole, const Point &about)
  {
    const auto area = [this] {
      double sum = 0;
      for (const Covered &each : under)
        sum += each.counted.size;
      return sum;
    };
    const double found = area();
    const bool   all_upright =
      std::all_of(under.begin(), under.end(), [](const Covered &c) { return c.facet.share == 1; });
    if (all_upright && found >= (1 - rounding) * whole)
      return found;
    count_symmetric(about);
    return area();
  }

  void Cover::add_weights(std::vector<VertexWeight> &weights,
                          const FacetMesh           &mesh,
                          const double               spread,
                          const double               area) const
  {
    for (const Covered &each : under)
      if (each.counted.size > 0)
        {
          const auto integral = each.facet.integrals(each.counted);
          for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
            dem::add(weights, mesh.facet[static_cast<std::size_t>(each.facet.number)][c], spread / area * integral[c]);
        }
  }
} // namespace dem::cells
