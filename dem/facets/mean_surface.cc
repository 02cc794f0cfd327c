#include "dem/facets/mean_surface.h"

#include "dem/facets/facet_axes.h"

#include <Eigen/LU>

#include <cmath>

namespace dem
{
  using namespace cells;
  using Eigen::Vector3d;

  namespace
  {
    /** The tangential plane of the undeformed face at the point of a zone. */
    Tangents tangents_then(const FacetMesh             &mesh,
                           const FlatFaces             &faces,
                           const std::vector<Vector3d> &place,
                           const ContactZone           &zone)
    {
      const auto &corner   = mesh.facet[static_cast<std::size_t>(zone.facet)];
      Tangents    tangents = faces.plane_of(zone.facet);
      tangents.origin      = Vector3d::Zero();
      for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
        tangents.origin += zone.parts.front().weight[c] * mesh.vertex[static_cast<std::size_t>(corner[c])];
      const int      normal = mesh.corners == 3 ? 2 : 1;
      const Vector3d then   = facet_axes(mesh, mesh.vertex, zone.facet).col(normal),
                     now    = facet_axes(mesh, place, zone.facet).col(normal);
      if (then.dot(tangents.across) * now.dot(zone.direction) < 0)
        tangents.across *= -1; // the other side of a plate: along the same axes
      return tangents;
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
        facet_axes(mesh, mesh.vertex, zone.facet) * facet_axes(mesh, place, zone.facet).transpose();
      then.front().centre = tangents.origin - zone.distance * tangents.across;
      for (std::size_t k = 1; k < spheres.size(); ++k)
        then[k].centre = then.front().centre + back * (spheres[k].centre - spheres.front().centre);
      return then;
    }

    Polygon moved(const Polygon &cell, const Point &by)
    {
      Polygon there = cell;
      for (std::size_t k = 0; k < static_cast<std::size_t>(there.count); ++k)
        there.corner[k] += by;
      return there;
    }
  } // namespace

  MeanSurface::MeanSurface(const FacetMesh             &mesh_,
                           const FlatFaces             &faces_,
                           const std::vector<Vector3d> &place_,
                           const ContactZone           &zone,
                           const TouchingSphere        &touching_)
    : mesh(mesh_)
    , faces(faces_)
    , place(place_)
    , touching(touching_)
    , centre(touching_.spheres.front().centre)
    , radius(touching_.spheres.front().radius)
    , from(zone.facet)
  {
    const Tangents tangents = tangents_then(mesh, faces, place, zone);
    cell    = cell_of(spheres_then(mesh, place, zone, tangents, touching.spheres), tangents, mesh.corners == 2);
    whole   = area_of(cell).size;
    start   = faces.plane_of(from).of(tangents.origin);
    spreads = !faces.on_rim(from, zone.parts.front().weight) && !faces.in_plane(from).holds(moved(cell, start));
    if (touching.before.facet >= 0)
      {
        from  = touching.before.facet;
        start = faces.plane_of(from).of(touching.before.place);
      }
  }

  MeanSurface::Mean
  MeanSurface::mean_at(const Point &at, const std::int32_t near, const FacetsAround &around, Cover &cover) const
  {
    cover.find(mesh, around, moved(cell, at), near, [&](const std::int32_t number) {
      return faces.share_face(number, near) ? &faces.in_plane(number) : nullptr;
    });
    Mean mean;
    mean.at    = at;
    mean.area  = cover.count(whole, at);
    mean.whole = mean.area >= (1 - rounding) * whole;
    for (const Covered &each : cover.parts())
      if (!mean.inside && each.facet.holds(at))
        {
          mean.inside = true;
          mean.facet  = each.facet.number;
        }
    mean.inside = mean.inside && mean.area > rounding * whole;
    if (mean.inside)
      integrate(mean, cover);
    return mean;
  }

  void MeanSurface::integrate(Mean &mean, const Cover &cover) const
  {
    Vector3d              sum = Vector3d::Zero(), sum_along[2] = {sum, sum}, sum_bend[2][2] = {{sum, sum}, {sum, sum}};
    std::array<double, 2> area_along = {0, 0};
    Vector3d              at = sum, at_along[2] = {sum, sum}; // the point itself
    for (const Covered &each : cover.parts())
      {
        const auto    &number   = mesh.facet[static_cast<std::size_t>(each.facet.number)];
        const Vector3d first    = place[static_cast<std::size_t>(number[0])] - centre;
        Vector3d       slope[2] = {Vector3d::Zero(), Vector3d::Zero()}, origin = first;
        for (std::size_t c = 1; c < static_cast<std::size_t>(mesh.corners); ++c)
          {
            const HalfPlane &shape = each.facet.shape[c];
            const Vector3d   side  = place[static_cast<std::size_t>(number[c])] - centre - first;
            origin += shape.at_origin * side;
            slope[0] += shape.slope.x() * side;
            slope[1] += shape.slope.y() * side;
          }
        const auto integral = [&](const Area &over) -> Vector3d {
          return over.size * origin + over.moment.x() * slope[0] + over.moment.y() * slope[1];
        };
        sum += integral(each.counted);
        for (std::size_t a = 0; a < 2; ++a)
          {
            area_along[a] += each.glide[a].size;
            sum_along[a] += integral(each.glide[a]);
            for (std::size_t b = 0; b < 2; ++b)
              sum_bend[a][b] += each.glide[b].size * slope[a];
          }
        if (each.facet.number == mean.facet)
          {
            at          = integral({1, mean.at});
            at_along[0] = slope[0];
            at_along[1] = slope[1];
          }
      }
    // Of a whole cell area_along is zero, and its spread is one.
    const double part = spread_part(mean.area, radius), full = part < 1 ? mean.area / part : mean.area;
    mean.place = sum / full + (1 - part) * at;
    for (std::size_t a = 0; a < 2; ++a)
      mean.along[a] = part < 1 ? Vector3d((sum_along[a] - area_along[a] * at) / full + (1 - part) * at_along[a]) :
                                 Vector3d((sum_along[a] - area_along[a] * mean.place) / full);
    for (std::size_t a = 0; a < 2; ++a)
      {
        const auto row                           = static_cast<Eigen::Index>(a);
        mean.slope[static_cast<Eigen::Index>(a)] = -mean.along[a].dot(mean.place);
        for (std::size_t b = 0; b < 2; ++b)
          mean.bend(row, static_cast<Eigen::Index>(b)) =
            mean.along[a].dot(mean.along[b]) + (mean.whole ? mean.place.dot(sum_bend[a][b]) / mean.area : 0.0);
      }
  }

  Point MeanSurface::step(const Mean &mean) const
  {
    constexpr double level = 1e-8; // of the slope that is left
    const double     far   = mean.place.norm();
    if (mean.slope.norm() < level * far)
      return Point::Zero();
    if (mesh.corners == 2)
      return {mean.slope.x() / (mean.bend(0, 0) > 0 ? mean.bend(0, 0) : mean.along[0].squaredNorm()), 0};
    if (mean.bend(0, 0) > 0 && mean.bend.determinant() > 0)
      return mean.bend.inverse() * mean.slope;
    Eigen::Matrix2d metric; // after Gauss and Newton: always downhill
    metric << mean.along[0].squaredNorm(), mean.along[0].dot(mean.along[1]), mean.along[0].dot(mean.along[1]),
      mean.along[1].squaredNorm();
    return metric.inverse() * mean.slope;
  }

  bool MeanSurface::nearer(const Mean &next, const Mean &now) const
  {
    constexpr double flat = 1e-4; // so near to level that rounding hides what is gained of the distance
    return next.inside && (next.place.squaredNorm() < now.place.squaredNorm() ||
                           (now.slope.norm() < flat * now.place.norm() && next.slope.norm() < 0.5 * now.slope.norm()));
  }

  bool MeanSurface::nearest(const FacetsAround &around, SpreadRoom &room) const
  {
    constexpr int most = 20, halves = 6;
    if (!spreads)
      return false;
    Mean now = mean_at(start, from, around, room.cover);
    if (!now.inside)
      return false;
    bool known = true; // the cover is that of now
    for (int n = 0; n < most; ++n)
      {
        Point by = step(now);
        if (by.isZero(0))
          break;
        by *= std::min(1.0, 0.5 * radius / by.norm());
        bool better = false;
        for (int h = 0; h < halves && !better; ++h, by *= 0.5)
          {
            const Mean next = mean_at(now.at + by, now.facet, around, room.cover);
            better = known = nearer(next, now);
            if (better)
              now = next;
          }
        if (!better)
          break;
      }
    if (!known)
      now = mean_at(now.at, now.facet, around, room.cover);
    SpreadContact &found = room.found;
    const double   part  = spread_part(now.area, radius);
    found.weights.clear();
    room.cover.add_weights(found.weights, mesh, part, now.area);
    if (part < 1)
      {
        const auto weight = faces.in_plane(now.facet).integrals({1, now.at});
        for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.corners); ++c)
          add(found.weights, mesh.facet[static_cast<std::size_t>(now.facet)][c], (1 - part) * weight[c]);
      }
    found.place   = dem::mean(found.weights, place);
    found.overlap = touching.reaches - (found.place - centre).norm();
    found.stands  = {now.facet, faces.plane_of(now.facet).in_space(now.at)};
    return true;
  }
} // namespace dem
