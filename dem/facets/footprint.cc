#include "dem/facets/footprint.h"

#include "dem/facets/ground.h"
#include "dem/facets/mean_surface.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace dem
{
  using namespace cells;
  using Eigen::Vector3d;

  namespace
  {
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
  } // namespace

  Footprint::Footprint(const FacetMesh &mesh)
    : around(mesh)
    , faces(mesh, around)
  {
  }

  bool Footprint::spread(const FacetMesh                   &mesh,
                         const std::vector<Vector3d>       &place,
                         const ContactZone                 &zone,
                         const std::vector<StandingSphere> &spheres,
                         const double                       reaches,
                         SpreadContact                     &found) const
  {
    if (zone.parts.size() == 1 && faces.is_flat(zone.facet))
      return MeanSurface(mesh, around, place, zone, spheres).nearest(reaches, found);
    const Tangents tangents(zone.place, zone.direction, mesh.corners == 2);
    const Ground   ground(mesh, place, tangents, cell_of(spheres, tangents, mesh.corners == 2), spheres.front().radius);
    if (zone.parts.size() == 1 && ground.lies_in(zone.facet))
      return false;
    std::vector<Covered> under = ground.covered(around, zone.facet);
    const double         area  = count(under, area_of(ground.cell).size),
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
