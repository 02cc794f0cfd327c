#include "base/errors.h"
#include "dem/genesis/aggregates.h"
#include "dem/laws/linear_contact.h"
#include "dem/specimen/packed_clumps.h"
#include "dem/specimen/specimen.h"

#include <catch2/catch.hpp>

#include <cmath>

using dem::Polygon;

namespace
{
  dem::AggregateParameters published()
  {
    dem::AggregateParameters p;
    p.bounds    = {5e-3, 7e-3, 9e-3, 11e-3, 13e-3, 15e-3};
    p.clearance = 1e-3;
    return p;
  }

  dem::Vessel box(const double width, const double height)
  {
    dem::Vessel vessel;
    vessel.size = {width, height, 0};
    return vessel;
  }

  /** A square grid of discs that touch. */
  dem::Packing grid(const int count, const double radius)
  {
    dem::Packing packing;
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i)
        {
          packing.centre.emplace_back((2 * i + 1) * radius, (2 * j + 1) * radius, 0);
          packing.radius.push_back(radius);
        }
    return packing;
  }

  dem::SpecimenParameters in_plane(const double density)
  {
    dem::SpecimenParameters p;
    p.physics.dimension = 2;
    p.density           = density;
    p.interaction_ratio = 1;
    p.thickness         = 1;
    return p;
  }

  dem::LinearContactParameters stiff()
  {
    dem::LinearContactParameters p;
    p.effective_modulus = 1e9;
    return p;
  }
} // namespace

TEST_CASE("area, centroid and polar moment of polygons are those of closed forms")
{
  const double a = 3, b = 5;
  Polygon      rectangle{{{1, 2}, {1 + a, 2}, {1 + a, 2 + b}, {1, 2 + b}}};
  CHECK(rectangle.area() == Approx(a * b).epsilon(1e-14));
  CHECK(rectangle.centroid().x() == Approx(1 + a / 2).epsilon(1e-14));
  CHECK(rectangle.centroid().y() == Approx(2 + b / 2).epsilon(1e-14));
  CHECK(rectangle.polar_moment() == Approx((a * a + b * b) / 12).epsilon(1e-13));
  const Polygon triangle{{{0, 0}, {a, 0}, {0, b}}};
  CHECK(triangle.polar_moment() == Approx((a * a + b * b) / 18).epsilon(1e-13));
  CHECK(rectangle.holds({1, 4}));
  CHECK(!rectangle.holds({0.999, 4}));
}

TEST_CASE("random polygons have four to six corners, a convex outline and the area of their circle")
{
  dem::UniformRandom random(1);
  int                corners[7] = {};
  for (int k = 0; k < 4000; ++k)
    {
      const Polygon polygon = dem::random_polygon(2, 4, 6, random);
      REQUIRE(polygon.corners.size() >= 4);
      REQUIRE(polygon.corners.size() <= 6);
      ++corners[polygon.corners.size()];
      REQUIRE(polygon.area() == Approx(M_PI * 4).epsilon(1e-12));
      REQUIRE(polygon.holds(polygon.centroid()));
      for (const auto &corner : polygon.corners)
        REQUIRE(dem::separation(polygon, {{corner, corner, corner}}) <= 1e-12);
    }
  CHECK(corners[4] > 0);
  CHECK(corners[5] > corners[6] / 2);
  CHECK(corners[6] > 0);
}

TEST_CASE("aggregates lie wholly inside their box and apart from each other, the same for a seed")
{
  const auto vessel = box(0.2, 0.1);
  const auto all = dem::place_aggregates(published(), vessel), again = dem::place_aggregates(published(), vessel);
  REQUIRE(all.size() == 59 + 28 + 15 + 8 + 4);
  double area = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    {
      area += all[i].area();
      for (const auto &x : all[i].corners)
        CHECK((x.x() >= 0 && x.x() <= 0.2 && x.y() >= 0 && x.y() <= 0.1));
      for (std::size_t j = 0; j < i; ++j)
        CHECK(dem::separation(all[i], all[j]) >= 1e-3);
      CHECK(all[i].corners == again[i].corners);
    }
  CHECK(area / 0.02 == Approx(0.288).margin(0.004)); // sizes are rounded to classes
  auto other = published();
  other.seed = 2;
  CHECK(dem::place_aggregates(other, vessel).front().corners != all.front().corners);
}

TEST_CASE("aggregates that find no place are refused")
{
  auto crowded      = published();
  crowded.clearance = 0.02;
  CHECK_THROWS_AS(dem::place_aggregates(crowded, box(0.2, 0.1)), base::InputError);
}

TEST_CASE("particles in a polygon become pebbles of a body with the polygon's mass, centre and inertia")
{
  dem::Packing  packing = grid(10, 0.5e-3);
  const Polygon square{{{2e-3, 3e-3}, {6e-3, 3e-3}, {6e-3, 6e-3}, {2e-3, 6e-3}}};
  dem::make_pebbles(packing, {square}, "mortar", "aggregate");
  int pebbles = 0;
  for (std::size_t i = 0; i < packing.size(); ++i)
    {
      CHECK((packing.clump[i] == 0) == square.holds(packing.centre[i].head<2>()));
      CHECK(packing.material[i] == (packing.clump[i] == 0 ? 1 : 0));
      pebbles += packing.clump[i] == 0;
    }
  CHECK(pebbles == 12);
  CHECK_NOTHROW(dem::check_packing(packing, "packing"));

  const double                                       density = 2650;
  const dem::Materials<dem::LinearContactParameters> materials(
    {{"mortar", stiff(), 2000}, {"aggregate", stiff(), density}});
  const dem::LinkMaterials both(materials);
  dem::Specimen            specimen(packing, in_plane(2000), both);
  dem::add_packed_clumps(specimen, packing, both);
  REQUIRE(specimen.clumps().size() == 1);
  const double mass = density * 12e-6;
  // Turn it freely: spin stays, and what turns it is its inertia m (a^2 + b^2)/12.
  const Eigen::Vector3d spin(0, 0, 3);
  for (std::size_t i = 0; i < packing.size(); ++i)
    if (packing.clump[i] == 0)
      specimen.set_velocity(i, spin.cross(packing.centre[i] - Eigen::Vector3d(4e-3, 4.5e-3, 0)), spin);
  CHECK(specimen.clumps().state(0).position.x() == Approx(4e-3));
  CHECK(specimen.clumps().state(0).position.y() == Approx(4.5e-3));
  CHECK(specimen.clumps().state(0).angular_momentum.z() == Approx(3 * mass * (16e-6 + 9e-6) / 12).epsilon(1e-12));
}

TEST_CASE("a free clump of a polygon keeps its spin, and answers a central force as its mass")
{
  dem::Packing  packing = grid(4, 0.5e-3);
  const Polygon square{{{0, 0}, {4e-3, 0}, {4e-3, 4e-3}, {0, 4e-3}}};
  dem::make_pebbles(packing, {square}, "mortar", "aggregate");
  packing.material.clear();
  packing.material_names.clear();
  const dem::LinkMaterials material(stiff());
  dem::Specimen            specimen(packing, in_plane(2650), material);
  dem::add_packed_clumps(specimen, packing, material);
  const double          mass = 2650 * 16e-6;
  const Eigen::Vector3d middle(2e-3, 2e-3, 0), spin(0, 0, 5);
  for (std::size_t i = 0; i < packing.size(); ++i)
    specimen.set_velocity(i, spin.cross(packing.centre[i] - middle), spin);
  for (std::size_t i = 0; i < packing.size(); ++i)
    specimen.partners().add_force(i, {0.5, 0, 0}, {0, 0, 0});
  specimen.advance(1000);
  const double time = specimen.time();
  CHECK(std::abs(specimen.clumps().state(0).spin.z() / 5 - 1) < 1e-12);
  CHECK(specimen.clumps().state(0).position.x() - 2e-3 == Approx(0.5 * 8 / mass * time * time).epsilon(2e-3));
}

TEST_CASE("a polygon with two pebbles is refused")
{
  dem::Packing packing = grid(4, 0.5e-3);
  CHECK_THROWS_AS(dem::make_pebbles(packing, {Polygon{{{0, 0}, {2e-3, 0}, {2e-3, 0.9e-3}, {0, 0.9e-3}}}}, "a", "b"),
                  base::InputError);
}
