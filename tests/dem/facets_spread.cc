// Contacts that are spread over the surface under a sphere: forces as the slope of an energy, where the surface was flat.
#include "tests/dem/facets_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace walls;

namespace
{
  constexpr double ball_radius = 0.01;

  /** A carpet of small facets under a sphere. */
  struct Carpet
  {
    dem::FacetMesh        mesh;
    dem::Footprint        footprint{mesh};
    std::vector<Vector3d> place = mesh.vertex;

    /** Of a contact at the nearest point. */
    dem::ContactZone zone(const Vector3d &centre) const
    {
      const double                search = dem::Footprint::reach * ball_radius;
      std::vector<dem::NearPoint> near;
      for (std::size_t f = 0; f < mesh.size(); ++f)
        {
          const dem::FacetPoint point = dem::closest_on_facet(mesh, place, f, centre);
          const double          d     = (point.place - centre).norm();
          if (d < search)
            near.push_back({static_cast<std::int32_t>(f), point, d, (point.place - centre) / d});
        }
      footprint.keep_own(mesh, place, centre, near);
      dem::ZoneRoom room;
      dem::contact_zones(near, centre, search, room);
      dem::ContactZone zone = *room.zones.begin();
      zone.overlap -= search - ball_radius;
      return zone;
    }

    dem::SpreadContact contact(const Vector3d &centre) const
    {
      dem::SpreadRoom                        room;
      const std::vector<dem::StandingSphere> alone = {{centre, ball_radius}};
      REQUIRE(footprint.spread(mesh, place, zone(centre), {alone, ball_radius, {}}, room));
      return room.found;
    }
  };

  /** A flat one, in which a dent has been made that is not just under the sphere. */
  struct Dented : Carpet
  {
    explicit Dented(const double depth)
      : Carpet{patch(0.03, 12)}
    {
      dem::UniformRandom random(7);
      for (Vector3d &x : place)
        {
          const double r = (x.head<2>() - Eigen::Vector2d(2.2e-3, -1.1e-3)).norm() / 7e-3;
          x += depth * Vector3d(0.1 * random(), 0.1 * random(), -std::exp(-r * r) + 0.05 * random());
        }
    }
  };

  using dem::cells::Point, dem::cells::Polygon, dem::cells::Side;

  /** A square about a contact, cut by the surface's edge and by the mirror image of another through the contact. */
  Polygon cell_about(const Point &contact)
  {
    Polygon square;
    for (const Point &corner : {Point(-1, -1), Point(1, -1), Point(1, 1), Point(-1, 1)})
      square.add(contact + corner, Side::cell);
    dem::cells::cut(square, {0.6, Point(-0.8, 0.3)}, Side::surface);
    dem::cells::cut(square, dem::cells::HalfPlane{0.7, Point(-0.2, -0.9)}.mirrored(contact), Side::mirrored);
    return square;
  }
} // namespace

TEST_CASE("area and moment of a cell change as the sides that glide with its contact sweep over the surface",
          "[facets]")
{
  const Point   contact(0.05, -0.1);
  const Polygon cell = cell_about(contact);
  for (const Side kind : {Side::surface, Side::cell, Side::mirrored})
    REQUIRE(std::count(cell.side.begin(), cell.side.begin() + cell.count, kind) > 0);
  const auto   glide = dem::cells::glide_of(cell);
  const double h     = 1e-6;
  for (int d = 0; d < 2; ++d)
    {
      const auto ahead  = dem::cells::area_of(cell_about(contact + h * Point::Unit(d))),
                 behind = dem::cells::area_of(cell_about(contact - h * Point::Unit(d)));
      const auto &swept = glide[static_cast<std::size_t>(d)];
      CHECK(swept.size == Approx((ahead.size - behind.size) / (2 * h)).epsilon(1e-8));
      CHECK((swept.moment - (ahead.moment - behind.moment) / (2 * h)).norm() < 1e-8);
    }
}

TEST_CASE("on a curved surface as it was made a spread contact overlaps as one at a point does, and in a dent by the "
          "dent less",
          "[facets]")
{
  const double   across = 0.06;
  const auto     round  = [&](double x, double) { return std::sqrt(across * across - x * x) - across; };
  Carpet         carpet{patch(0.03, 24, round, 0)};
  const Vector3d centre(0.3e-3, 0.2e-3, ball_radius - 1e-4);
  const double   at_point = carpet.zone(centre).overlap;
  CHECK(at_point == Approx(1e-4).epsilon(0.15)); // facets are chords
  const dem::SpreadContact whole = carpet.contact(centre);
  CHECK(whole.overlap == Approx(at_point).epsilon(1e-9));
  CHECK((whole.place - carpet.zone(centre).place).norm() > 2e-4); // the mean lies well below the contact

  double mean = 0;
  for (const dem::VertexWeight &part : whole.weights)
    {
      Vector3d    &x = carpet.place[static_cast<std::size_t>(part.vertex)];
      const double r = x.x() / 6e-3, dent = 2e-5 * std::exp(-r * r); // still convex
      mean += part.weight * dent;
      x.z() -= dent;
    }
  CHECK(whole.overlap - carpet.contact(centre).overlap == Approx(mean).epsilon(0.02));
}

TEST_CASE("forces of a spread contact are the slope of its energy in any dent of a flat surface", "[facets]")
{
  for (const double depth : {1e-4, 3e-4})
    {
      Dented                   dented(depth);
      const Vector3d           centre(0.8e-3, 0.5e-3, ball_radius - depth - 1e-4);
      const dem::SpreadContact contact = dented.contact(centre);
      const Vector3d           towards = (contact.place - centre).normalized();
      CHECK(contact.overlap > 0);
      CHECK(contact.overlap == Approx(ball_radius - (contact.place - centre).norm()).epsilon(1e-9));
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
          if ((dented.place[v] - centre).norm() > 2.5 * ball_radius)
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
