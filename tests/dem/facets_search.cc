// Which facets are near which spheres: none is missed, nothing is visited in vain, and the cost is linear.
#include "facets_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace walls;

namespace
{
  using Touching = std::set<std::pair<std::size_t, std::size_t>>; ///< particle, surface

  Touching by_all_pairs(const dem::Specimen &specimen)
  {
    Touching found;
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      for (std::size_t s = 0; s < specimen.surfaces().size(); ++s)
        {
          const dem::Surface &surface = specimen.surfaces().at(s);
          const auto          ball    = specimen.particle(i);
          for (std::size_t f = 0; f < surface.mesh.size(); ++f)
            if (surface.distance(f, ball.position) < ball.radius)
              found.insert({i, s});
        }
    return found;
  }

  Touching as_found(const dem::Specimen &specimen)
  {
    Touching found;
    for (const dem::WallContact &contact : specimen.surfaces().contacts())
      found.insert({contact.particle, contact.surface});
    return found;
  }
} // namespace

TEST_CASE("no sphere that touches a facet is missed, whatever moves and whatever the sizes", "[dem][facets][slow]")
{
  dem::UniformRandom random(21);
  dem::Packing       packing;
  for (int i = 0; i < 120; ++i)
    {
      packing.centre.push_back(random_place(random, 0.3));
      packing.radius.push_back(0.002 * std::pow(10.0, random())); // a decade of sizes
    }
  dem::SpecimenParameters p = loose();
  p.physics.contacts        = false; // they pass through each other: the walls are tested
  dem::Specimen specimen(packing, p, contact(0, 1e4));
  // A net of small facets that is driven, a large plate that turns, a mast of slivers, a box around all.
  const auto net = specimen.surfaces().add(
    wall(patch(0.35, 20, [](double x, double) { return 0.03 * std::sin(20 * x) - 0.36; }), 0, 1e5));
  const auto plate = specimen.surfaces().add(wall(dem::plate({0.45, -0.3, -0.3}, {0.1, 0.6, 0}, {0, 0, 0.6}), 0, 1e5));
  specimen.surfaces().add(wall(dem::cylinder({0, 0.5, -0.4}, {0, 0.5, 0.4}, 0.05, 40, true), 0, 1e5));
  specimen.surfaces().add(
    wall(dem::box({-0.6, -0.6, -0.5}, {0.6, 0.6, 0.35}, {true, true, true, true, true, true}), 0, 1e5));
  for (std::size_t i = 0; i < packing.size(); ++i)
    specimen.set_velocity(i, random_place(random, 2), {0, 0, 0});
  std::size_t contacts = 0;
  for (int k = 0; k < 80; ++k)
    {
      std::vector<Vector3d> velocity;
      for (const Vector3d &x : specimen.surfaces().at(net).place)
        velocity.push_back({0, 0, 0.5 * std::sin(9 * x.y() + 100 * specimen.time())});
      specimen.surfaces().set_vertex_velocities(net, velocity);
      specimen.surfaces().set_motion(plate, {-0.3, 0, 0}, {0, 0.5, 1},
                                     k == 0 ? Vector3d(0.5, 0, 0) : specimen.surfaces().at(plate).centre);
      specimen.partners().find_surface_forces();
      const Touching found = as_found(specimen);
      REQUIRE(found == by_all_pairs(specimen));
      contacts += found.size();
      specimen.advance(50);
    }
  CHECK(contacts > 50);
  CHECK(specimen.surfaces().searches()[0] < 1000); // of 4000 steps
}

TEST_CASE("no pair is visited while nothing can touch", "[dem][facets]")
{
  std::vector<Vector3d> centres;
  for (int i = 0; i < 100; ++i)
    centres.push_back({0.03 * (i % 10), 0.03 * (i / 10), 0.0499});
  dem::Specimen specimen(balls(centres, 0.01), loose(), contact());
  specimen.surfaces().add(wall(patch(1, 30)));
  for (std::size_t i = 0; i < centres.size(); ++i)
    specimen.set_velocity(i, {0.02, 0.01, 0}, {0, 0, 0});
  specimen.advance(1);
  const auto first = specimen.surfaces().searches();
  CHECK(first[0] == 1);
  specimen.advance(200); // 1.1e-4 m of a margin of 3.3e-3 m
  CHECK(specimen.surfaces().searches() == first);
}

TEST_CASE("a surface of some particles is not there for others, and several have each their own friction",
          "[dem][facets]")
{
  // Balls that glide over the same plate: rough for the second, smooth for the third, not there for the first.
  const double radius = 0.01, g = 9.81;
  auto         how = loose();
  how.gravity      = {0, 0, -g};
  dem::Specimen specimen(balls({{0, 0, radius}, {0.1, 0, radius}, {0.2, 0, radius}}, radius), how, contact());
  auto          plate = dem::plate({-0.1, -0.1, 0}, {0.6, 0, 0}, {0, 0.2, 0});
  auto          rough = wall(plate, 0.5), smooth = wall(plate, 0);
  rough.particles  = {1};
  smooth.particles = {2};
  specimen.surfaces().add(rough);
  specimen.surfaces().add(smooth);
  for (std::size_t i = 0; i < 3; ++i)
    specimen.set_velocity(i, {1, 0, 0}, {0, 0, 0});
  while (specimen.time() < 0.1)
    specimen.advance(1);
  const double t = specimen.time();
  CHECK(specimen.particle(0).position.z() == Approx(radius - 0.5 * g * t * t).epsilon(1e-3));
  CHECK(specimen.particle(1).velocity.x() == Approx(5.0 / 7).epsilon(1e-2)); // slid until it rolled
  CHECK(specimen.particle(2).velocity.x() == Approx(1).epsilon(1e-12));
  CHECK(specimen.particle(2).position.z() == Approx(radius).epsilon(1e-2));
  rough.particles = {3};
  CHECK_THROWS_WITH(specimen.surfaces().add(rough), Catch::Contains("particle 4"));
}

TEST_CASE("pairs that are tested for a list grow in proportion to spheres and facets", "[dem][facets]")
{
  std::vector<double> per_item;
  for (const int side : {16, 32, 64})
    {
      std::vector<Vector3d> centres;
      for (int k = 0; k < 4; ++k)
        for (int j = 0; j < side; ++j)
          for (int i = 0; i < side; ++i)
            centres.push_back(0.021 * Vector3d(i, j, k + 0.55) - 0.0105 * Vector3d(side, side, 0));
      dem::Specimen specimen(balls(centres, 0.01), loose(), contact());
      specimen.surfaces().add(wall(patch(0.0105 * side, side)));
      specimen.partners().find_surface_forces();
      per_item.push_back(double(specimen.surfaces().searches()[1]) / double(centres.size() + 2 * side * side));
    }
  INFO(per_item[0] << " " << per_item[1] << " " << per_item[2]);
  CHECK(per_item[2] < 15);
  CHECK(per_item[2] == Approx(per_item[1]).epsilon(0.1));
  CHECK(per_item[1] == Approx(per_item[0]).epsilon(0.15));
}
