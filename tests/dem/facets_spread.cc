// Contacts that are spread over the surface under a sphere: forces as the slope of an energy, where the surface was flat.
#include "tests/dem/facets_fixture.h"

#include <catch2/catch.hpp>

using namespace walls;

namespace
{
  constexpr double radius = 0.01;

  /** A flat carpet of small facets, in which a dent has been made that is not just under the sphere. */
  struct Dented
  {
    dem::FacetMesh        mesh = patch(0.03, 12);
    dem::Footprint        footprint{mesh};
    std::vector<Vector3d> place = mesh.vertex;

    explicit Dented(const double depth)
    {
      dem::UniformRandom random(7);
      for (Vector3d &x : place)
        {
          const double r = (x.head<2>() - Eigen::Vector2d(2.2e-3, -1.1e-3)).norm() / 7e-3;
          x += depth * Vector3d(0.1 * random(), 0.1 * random(), -std::exp(-r * r) + 0.05 * random());
        }
    }

    dem::SpreadContact contact(const Vector3d &centre) const
    {
      const double                look = dem::Footprint::reach * radius;
      std::vector<dem::NearPoint> near;
      for (std::size_t f = 0; f < mesh.size(); ++f)
        {
          const dem::FacetPoint point = dem::closest_on_facet(mesh, place, f, centre);
          const double          d     = (point.place - centre).norm();
          if (d < look)
            near.push_back({static_cast<std::int32_t>(f), point, d, (point.place - centre) / d});
        }
      footprint.keep_own(mesh, place, centre, near);
      dem::ZoneRoom room;
      dem::contact_zones(near, centre, look, room);
      dem::ContactZone zone = *room.zones.begin();
      zone.overlap -= look - radius;
      dem::SpreadRoom                        room_of_spread;
      const std::vector<dem::StandingSphere> alone = {{centre, radius}};
      REQUIRE(footprint.spread(mesh, place, zone, {alone, radius, {}}, room_of_spread));
      return room_of_spread.found;
    }
  };
} // namespace

TEST_CASE("forces of a spread contact are the slope of its energy in any dent of a flat surface", "[facets]")
{
  for (const double depth : {1e-4, 3e-4})
    {
      Dented                   dented(depth);
      const Vector3d           centre(0.8e-3, 0.5e-3, radius - depth - 1e-4);
      const dem::SpreadContact contact = dented.contact(centre);
      const Vector3d           towards = (contact.place - centre).normalized();
      CHECK(contact.overlap > 0);
      CHECK(contact.overlap == Approx(radius - (contact.place - centre).norm()).epsilon(1e-9));
      // Of overlaps, in one metre of way. With weights that go with the dented surface it is the dent's slope, some hundredths.
      const double h = 1e-7, small = 1e-6;
      double       worst = 0;
      for (int d = 0; d < 3; ++d)
        {
          const Vector3d step = h * Vector3d::Unit(d);
          const double   slope =
            (dented.contact(centre + step).overlap - dented.contact(centre - step).overlap) / (2 * h);
          worst = std::max(worst, std::fabs(slope - towards[d]));
        }
      for (std::size_t v = 0; v < dented.place.size(); ++v)
        {
          if ((dented.place[v] - centre).norm() > 2.5 * radius)
            continue;
          double weight = 0;
          for (const dem::VertexWeight &part : contact.weights)
            weight += part.vertex == static_cast<std::int32_t>(v) ? part.weight : 0;
          for (int d = 0; d < 3; ++d)
            {
              double      &at   = dented.place[v][d];
              const double was  = at;
              at                = was + h;
              const double more = dented.contact(centre).overlap;
              at                = was - h;
              const double less = dented.contact(centre).overlap;
              at                = was;
              worst             = std::max(worst, std::fabs((more - less) / (2 * h) + weight * towards[d]));
            }
        }
      INFO("depth " << depth << ": " << worst);
      CHECK(worst < small);
    }
}
