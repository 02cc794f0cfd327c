#include "dem/facets/footprint.h"

#include "dem/facets/facet_axes.h"
#include "dem/facets/mean_surface.h"

#include <algorithm>

namespace dem
{
  using namespace cells;
  using Eigen::Vector3d;

  namespace
  {
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

  bool Footprint::spread(const FacetMesh             &mesh,
                         const std::vector<Vector3d> &place,
                         const ContactZone           &zone,
                         const TouchingSphere        &touching,
                         SpreadRoom                  &room) const
  {
    if (zone.parts.size() == 1 && faces.is_flat(zone.facet))
      return MeanSurface(mesh, faces, place, zone, touching).nearest(around, room);
    const Tangents tangents(zone.place, zone.direction, mesh.corners == 2);
    const Polygon  cell = cell_of(touching.spheres, tangents, mesh.corners == 2);
    Facet          facet(mesh, place, zone.facet, tangents);
    if (zone.parts.size() == 1 && facet.share == 1 && facet.holds(cell))
      return false;
    room.cover.find(mesh, around, cell, zone.facet, [&](const std::int32_t number) {
      facet = Facet(mesh, place, number, tangents);
      return facet.share > 0 ? &facet : nullptr;
    });
    const double area    = room.cover.count(area_of(cell).size, Point::Zero()),
                 spread  = spread_part(area, touching.spheres.front().radius);
    SpreadContact &found = room.found;
    found.weights.clear();
    room.cover.add_weights(found.weights, mesh, spread, area);
    const Vector3d point_then = add_point(found.weights, mesh, zone, spread);
    found.place               = mean(found.weights, place);
    // Heights of the mean surface above the point of the contact: what it was in the undeformed surface is its shape.
    const Vector3d mean_then = mean(found.weights, mesh.vertex);
    const Vector3d across_then =
      facet_axes(mesh, mesh.vertex, zone.facet) * facet_axes(mesh, place, zone.facet).transpose() * zone.direction;
    found.overlap =
      zone.overlap - zone.direction.dot(found.place - zone.place) + across_then.dot(mean_then - point_then);
    found.stands = {};
    return true;
  }
} // namespace dem
