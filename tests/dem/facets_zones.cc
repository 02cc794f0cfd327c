// Where spheres touch facets: nearest points, one contact per zone, continuity over edges.
#include "base/errors.h"
#include "dem/facets/contact_zones.h"
#include "facets_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace walls;
using Catch::Contains;

namespace
{
  std::vector<dem::ContactZone> zones_at(const dem::FacetMesh &mesh, const Vector3d &centre, const double radius)
  {
    std::vector<dem::NearPoint> near;
    for (std::size_t f = 0; f < mesh.size(); ++f)
      {
        const dem::FacetPoint point  = dem::closest_on_facet(mesh, mesh.vertex, f, centre);
        const Vector3d        branch = point.place - centre;
        if (branch.norm() < radius)
          near.push_back({static_cast<std::int32_t>(f), point, branch.norm(), branch.normalized()});
      }
    dem::ZoneRoom room;
    dem::contact_zones(near, centre, radius, room);
    return {room.zones.begin(), room.zones.end()};
  }

  /** Frictionless push of all zones, per stiffness [m]. */
  Vector3d push(const dem::FacetMesh &mesh, const Vector3d &centre, const double radius)
  {
    Vector3d sum(0, 0, 0);
    for (const dem::ContactZone &zone : zones_at(mesh, centre, radius))
      sum -= zone.share * zone.overlap * zone.direction;
    return sum;
  }

  /** Two plates that meet in the y axis; the second rises by the angle (falls where it is negative). */
  dem::FacetMesh fold(const double angle)
  {
    dem::FacetMesh mesh = dem::plate({-1, -1, 0}, {1, 0, 0}, {0, 2, 0});
    const auto     up   = dem::plate({0, -1, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 2, 0});
    const auto     n    = static_cast<std::int32_t>(mesh.vertex.size());
    mesh.vertex.insert(mesh.vertex.end(), up.vertex.begin(), up.vertex.end());
    for (const auto &f : up.facet)
      mesh.facet.push_back({f[0] + n, f[1] + n, f[2] + n});
    return mesh;
  }
} // namespace

TEST_CASE("nearest point of a triangle is the nearest of all its points, and its weights say where it is",
          "[dem][facets]")
{
  dem::UniformRandom random(1);
  for (int trial = 0; trial < 300; ++trial)
    {
      const std::array<Vector3d, 3> corner = {random_place(random, 1), random_place(random, 1),
                                              random_place(random, 1)};
      const Vector3d                x      = random_place(random, 2);
      const dem::FacetPoint         found  = dem::closest_on_triangle(corner, x);
      double                        least  = std::numeric_limits<double>::infinity();
      const int                     n      = 60;
      for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
          {
            const double u = double(i) / n, v = double(j) / n;
            least = std::min(least, (x - (1 - u - v) * corner[0] - u * corner[1] - v * corner[2]).norm());
          }
      const double distance = (x - found.place).norm();
      CHECK(distance <= least + 1e-12);
      CHECK(distance >= least - 0.06);
      Vector3d sum(0, 0, 0);
      double   weights = 0;
      for (std::size_t c = 0; c < 3; ++c)
        {
          CHECK(found.weight[c] >= -1e-15);
          weights += found.weight[c];
          sum += found.weight[c] * corner[c];
        }
      CHECK(weights == Approx(1).epsilon(1e-14));
      CHECK((sum - found.place).norm() < 1e-13);
    }
}

TEST_CASE("sphere on a flat patch of triangles has one contact, with the force of a plane, wherever it rests",
          "[dem][facets]")
{
  const dem::FacetMesh  mesh = patch(1, 8);
  dem::UniformRandom    random(2);
  std::vector<Vector3d> places;
  for (int trial = 0; trial < 300; ++trial)
    places.push_back(random_place(random, 0.5));
  for (const Vector3d &x : mesh.vertex) // on corners, and on edges and next to them
    if (x.cwiseAbs().maxCoeff() < 0.6)
      for (const double aside : {0.0, 1e-15, 1e-9, 1e-4})
        for (const Vector3d &to : {mesh.vertex[40], mesh.vertex[41], mesh.vertex[50]})
          places.push_back(x + 0.5 * (to - x) * (aside == 0 ? 0 : 1) + Vector3d(aside, -aside, 0));
  const double radius = 0.2;
  for (const Vector3d &place : places)
    for (const double depth : {1e-6, 1e-3, 0.05})
      {
        const Vector3d centre(place.x(), place.y(), radius - depth);
        REQUIRE(zones_at(mesh, centre, radius).size() == 1);
        const Vector3d force = push(mesh, centre, radius);
        CHECK(force.z() == Approx(depth).margin(1e-15));
        CHECK(force.head<2>().norm() < 1e-14);
      }
}

TEST_CASE("sphere touches a convex edge and a corner once, and each side of a hollow corner", "[dem][facets]")
{
  const dem::FacetMesh block = dem::box({0, 0, 0}, {1, 1, 1}, {true, true, true, true, true, true});
  const double         r = 0.1, depth = 1e-3, d = r - depth;
  CHECK(zones_at(block, {1 + d / std::sqrt(2), 0.5, 1 + d / std::sqrt(2)}, r).size() == 1);
  CHECK(zones_at(block, Vector3d::Ones() * (1 + d / std::sqrt(3)), r).size() == 1);
  CHECK((push(block, Vector3d::Ones() * (1 + d / std::sqrt(3)), r) - depth * Vector3d::Ones().normalized()).norm() <
        1e-14);
  // from inside: floor, floor and wall, floor and two walls
  CHECK((push(block, {0.5, 0.5, d}, r) - Vector3d(0, 0, depth)).norm() < 1e-14);
  CHECK((push(block, {d, 0.5, d}, r) - Vector3d(depth, 0, depth)).norm() < 1e-14);
  CHECK((push(block, {d, d, d}, r) - depth * Vector3d::Ones()).norm() < 1e-14);
  CHECK(zones_at(block, {d, d, d}, r).size() == 3);
}

namespace
{
  /** Largest change of the push from one to the next of n places along a way. */
  double largest_jump(const dem::FacetMesh &mesh, const Vector3d &from, const Vector3d &to, const double r, const int n)
  {
    Vector3d before = push(mesh, from, r);
    double   jump   = 0;
    for (int k = 1; k <= n; ++k)
      {
        const Vector3d force = push(mesh, from + (to - from) * k / n, r);
        jump                 = std::max(jump, (force - before).norm());
        before               = force;
      }
    return jump;
  }
} // namespace

TEST_CASE("push of an edge is continuous while a sphere goes over it, convex, flat and hollow", "[dem][facets][S11]")
{
  const double r = 0.1;
  for (const double angle : {-2.0, -1.0, -0.1, -1e-3, 1e-6, 1e-3, 0.01, 0.03, 0.1, 0.5, 1.0, 1.57})
    for (const double depth : {1e-5, 1e-4, 1e-3})
      {
        INFO("angle " << angle << ", depth " << depth);
        const dem::FacetMesh mesh = fold(angle);
        // On the first plate and over the edge; into a rise only until it presses as much as some depths.
        const double end =
          angle > 0 ? std::min(0.2 * r, 10 * depth / std::sin(angle) - r * std::tan(0.5 * angle)) : 0.5 * r;
        const Vector3d from(end - 0.7 * r, 0.013, r - depth), to(end, 0.013, r - depth);
        const double   coarse = largest_jump(mesh, from, to, r, 10000), fine = largest_jump(mesh, from, to, r, 80000);
        if (angle <= 1e-6)
          CHECK(fine <= 0.5 * coarse + 2e-6 * depth); // what jumps does so however short the steps
        // In a hollow it may jump by little where two caps become one.
        CHECK(fine <= 0.01 * std::max(depth, push(mesh, to, r).norm()));
      }
}

TEST_CASE("a surface that is none is refused by name", "[dem][facets][S14]")
{
  dem::FacetMesh flat = dem::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK_NOTHROW(dem::check_facets(flat, "floor", 3));
  CHECK_THROWS_WITH(dem::check_facets(flat, "floor", 2), Contains("wall floor") && Contains("segments"));
  dem::FacetMesh bad = flat;
  bad.vertex[2]      = {2, 0, 0};
  CHECK_THROWS_WITH(dem::check_facets(bad, "floor", 3), Contains("wall floor: facet 1 has zero area"));
  bad             = flat;
  bad.facet[1][2] = 7;
  CHECK_THROWS_WITH(dem::check_facets(bad, "floor", 3), Contains("facet 2 has vertex 8, and there are 4"));
  bad              = flat;
  bad.vertex[3][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(dem::check_facets(bad, "floor", 3), Contains("vertex 4 is not at a finite place"));
  CHECK_THROWS_WITH(dem::check_facets(dem::FacetMesh(), "floor", 3), Contains("has no facet"));
  CHECK_THROWS_WITH(dem::check_facets(dem::segment({1, 1, 0}, {1, 1, 0}), "side", 2), Contains("zero length"));
  CHECK_THROWS_WITH(dem::check_facets(dem::FacetMesh::plane({0, 0, 0}, {0, 0, 0}), "ground", 3), Contains("direction"));
}
