#include "dem/facets/mean_surface.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace dem
{
  using namespace cells;
  using Eigen::Vector3d;

  namespace
  {
    /** Columns that turn with a facet. */
    Eigen::Matrix3d axes_of(const FacetMesh &mesh, const std::vector<Vector3d> &place, const std::int32_t facet)
    {
      const auto     &corner = mesh.facet[static_cast<std::size_t>(facet)];
      const auto      at     = [&](const std::size_t c) { return place[static_cast<std::size_t>(corner[c])]; };
      Eigen::Matrix3d axes;
      axes.col(0) = (at(1) - at(0)).normalized();
      axes.col(2) =
        mesh.corners == 3 ? Vector3d(axes.col(0).cross(Vector3d(at(2) - at(0))).normalized()) : Vector3d::UnitZ();
      axes.col(1) = axes.col(2).cross(axes.col(0));
      return axes;
    }

    /** The tangential plane of the undeformed face at the point of a zone. */
    Tangents tangents_then(const FacetMesh &mesh, const std::vector<Vector3d> &place, const ContactZone &zone)
    {
      Vector3d    point  = Vector3d::Zero();
      const auto &corner = mesh.facet[static_cast<std::size_t>(zone.facet)];
      for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
        point += zone.parts.front().weight[c] * mesh.vertex[static_cast<std::size_t>(corner[c])];
      const int             normal = mesh.corners == 3 ? 2 : 1;
      const Eigen::Matrix3d then = axes_of(mesh, mesh.vertex, zone.facet), now = axes_of(mesh, place, zone.facet);
      const double          side = now.col(normal).dot(zone.direction) < 0 ? -1 : 1;
      return {point, side * then.col(normal), mesh.corners == 2};
    }

    /** Where spheres would stand beside the undeformed face: turned back with the facet. */
    std::vector<StandingSphere> spheres_then(const FacetMesh                   &mesh,
                                             const std::vector<Vector3d>       &place,
                                             const ContactZone                 &zone,
                                             const Tangents                    &tangents,
                                             const std::vector<StandingSphere> &spheres)
    {
      std::vector<StandingSphere> then = spheres;
      if (spheres.size() == 1)
        return then;
      const Eigen::Matrix3d back =
        axes_of(mesh, mesh.vertex, zone.facet) * axes_of(mesh, place, zone.facet).transpose();
      then.front().centre = tangents.origin - zone.distance * tangents.across;
      for (std::size_t k = 1; k < spheres.size(); ++k)
        then[k].centre = then.front().centre + back * (spheres[k].centre - spheres.front().centre);
      return then;
    }
  } // namespace

  MeanSurface::MeanSurface(const FacetMesh                   &mesh_,
                           const FacetsAround                &around_,
                           const std::vector<Vector3d>       &place_,
                           const ContactZone                 &zone,
                           const std::vector<StandingSphere> &spheres)
    : mesh(mesh_)
    , around(around_)
    , place(place_)
    , centre(spheres.front().centre)
    , radius(spheres.front().radius)
    , first(zone.facet)
    , tangents(tangents_then(mesh_, place_, zone))
    , cell(cell_of(spheres_then(mesh_, place_, zone, tangents, spheres), tangents, mesh_.corners == 2))
  {
  }

  MeanSurface::Mean MeanSurface::mean_at(const Point &at, const std::int32_t from) const
  {
    Tangents here = tangents;
    here.origin += at.x() * tangents.first + at.y() * tangents.second;
    const Ground         ground(mesh, mesh.vertex, here, cell, radius);
    std::vector<Covered> under = ground.covered(around, from);
    const double         whole = area_of(cell).size;
    Mean                 mean;
    mean.at              = at;
    mean.facet           = from;
    mean.area            = count(under, whole);
    mean.whole           = mean.area >= (1 - rounding) * whole;
    const double  spread = std::min(mean.area / (smallest_part * ground.square()), 1.0);
    constexpr int axes   = 2;
    std::fill(mean.along.begin(), mean.along.end(), Vector3d::Zero());
    add_spread(mean.weights, mesh, under, spread, mean.area);
    for (const Covered &each : under)
      {
        const auto &corner = mesh.facet[static_cast<std::size_t>(each.facet.number)];
        const auto  shape  = each.facet.shape(Point::Zero());
        for (int d = 0; d < axes && each.counted.size > 0; ++d)
          {
            const auto beside = each.facet.shape(radius * Point::Unit(d));
            for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
              mean.along[static_cast<std::size_t>(d)] += each.counted.size / mean.area * (beside[c] - shape[c]) /
                                                         radius * place[static_cast<std::size_t>(corner[c])];
          }
        if (mean.inside || !holds(each.facet, Point::Zero()))
          continue;
        mean.inside = true;
        mean.facet  = each.facet.number;
        for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners) && spread < 1; ++c)
          add(mean.weights, corner[c], (1 - spread) * shape[c]);
      }
    mean.place = dem::mean(mean.weights, place);
    return mean;
  }

  Vector3d MeanSurface::moves(const Mean &mean, const int along) const
  {
    // A cell that moves as it is takes the mean of the facets along; where it narrows, what it narrows to is asked.
    if (mean.whole)
      return mean.along[static_cast<std::size_t>(along)];
    constexpr double way    = 1e-5;
    const double     length = way * radius;
    const Mean       less   = mean_at(mean.at - length * Point::Unit(along), mean.facet),
               more         = mean_at(mean.at + length * Point::Unit(along), mean.facet);
    const Vector3d &from = less.inside ? less.place : mean.place, &to = more.inside ? more.place : mean.place;
    const int       lengths = (less.inside ? 1 : 0) + (more.inside ? 1 : 0);
    return lengths == 0 ? mean.along[static_cast<std::size_t>(along)] : Vector3d((to - from) / (lengths * length));
  }

  Point MeanSurface::step(const Mean &mean) const
  {
    constexpr double level = 1e-8; // of the slope that is left
    const Vector3d   away  = centre - mean.place;
    const Vector3d   one   = moves(mean, 0);
    if (mesh.corners == 2)
      return std::fabs(one.dot(away)) < level * away.norm() ? Point::Zero() :
                                                              Point(one.dot(away) / one.squaredNorm(), 0);
    const Vector3d other = moves(mean, 1);
    const Point    slope(one.dot(away), other.dot(away));
    if (slope.norm() < level * away.norm())
      return Point::Zero();
    Eigen::Matrix2d metric;
    metric << one.squaredNorm(), one.dot(other), one.dot(other), other.squaredNorm();
    return metric.inverse() * slope;
  }

  bool MeanSurface::nearest(const double reaches, SpreadContact &found) const
  {
    constexpr int most = 20, halves = 6;
    if (Ground(mesh, mesh.vertex, tangents, cell, radius).lies_in(first))
      return false; // mean and point are the same
    Mean now = mean_at(Point::Zero(), first);
    if (!now.inside || !(now.area > rounding * area_of(cell).size))
      return false; // on the rim
    for (int n = 0; n < most; ++n)
      {
        Point by = step(now);
        if (by.isZero(0))
          break;
        by *= std::min(1.0, 0.5 * radius / by.norm());
        bool nearer = false;
        for (int h = 0; h < halves && !nearer; ++h, by *= 0.5)
          {
            Mean next = mean_at(now.at + by, now.facet);
            nearer    = next.inside && (next.place - centre).squaredNorm() < (now.place - centre).squaredNorm();
            if (nearer)
              now = std::move(next);
          }
        if (!nearer)
          break;
      }
    found.weights = std::move(now.weights);
    found.place   = now.place;
    found.overlap = reaches - (now.place - centre).norm();
    return true;
  }
} // namespace dem
