// Spheres and discs on walls against closed forms: doc/theory/facets.md.
#include "facets_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace walls;

namespace
{
  constexpr double R = 0.01, g = 9.81;

  double stiffness(const int dimension, const double modulus = 1e7)
  {
    return dimension == 3 ? pi * R * modulus : 2 * 0.01 * modulus;
  }
  double mass(const int dimension) { return 2500 * (dimension == 3 ? 4.0 / 3 * pi * R * R * R : pi * R * R * 0.01); }

  /** What a ball of dimension 3 or a disc of dimension 2 lies on: a flat wall whose normal is the last axis of the dimension. */
  Vector3d up(const int dimension) { return dimension == 3 ? Vector3d::UnitZ() : Vector3d::UnitY(); }
} // namespace

TEST_CASE("a ball that hits a wall leaves it with its speed, after half a period of its spring, to round-off",
          "[dem][facets]")
{
  for (const int dimension : {2, 3})
    for (const bool plane : {true, false})
      {
        const Vector3d n = up(dimension);
        dem::Specimen  ball(balls({R * n}, R), loose(dimension), contact());
        ball.surfaces().add(wall(plane          ? dem::FacetMesh::plane({0, 0, 0}, n) :
                                 dimension == 3 ? patch(1, 5) :
                                                  dem::segment({-1, 0, 0}, {1, 0, 0})));
        const double omega = std::sqrt(stiffness(dimension) / mass(dimension)), speed = 0.7;
        const int    steps = 150;
        ball.set_time_step(2 / omega * std::sin(pi / (2 * steps))); // leap-frog then takes exactly so many to turn
        ball.set_velocity(0, -speed * n, {0, 0, 0});
        ball.advance(2);
        CHECK(ball.surfaces().contacts().size() == 1);
        ball.advance(steps / 2 - 2);
        const double deepest = R - ball.particle(0).position.dot(n);
        CHECK(deepest == Approx(speed / omega).epsilon(1e-3));
        ball.advance(steps / 2 + 1);
        CHECK(ball.particle(0).velocity.dot(n) == Approx(speed).epsilon(1e-12));
        ball.advance(1);
        CHECK(ball.surfaces().contacts().empty());
        CHECK(ball.energy().balance_error() < 1e-12);
        CHECK(ball.surfaces().at(0).momentum.dot(n) == Approx(-2 * mass(dimension) * speed).epsilon(1e-12));
      }
}

TEST_CASE("a block on an incline stops, slides on or gains speed as Coulomb's friction says", "[dem][facets][slow]")
{
  const double friction = 0.4, speed = 0.3;
  for (const int dimension : {2, 3})
    for (const double slope : {0.0, 0.3, 0.4, 0.6})
      {
        const double            angle = std::atan(slope);
        const Vector3d          n     = up(dimension);
        dem::SpecimenParameters p     = loose(dimension);
        p.physics.rotations           = false; // it slides and does not roll
        p.gravity                     = g * (std::sin(angle) * Vector3d::UnitX() - std::cos(angle) * n);
        const double  sag             = mass(dimension) * g * std::cos(angle) / stiffness(dimension);
        dem::Specimen block(balls({(R - sag) * n}, R), p, contact());
        block.surfaces().add(wall(dimension == 3 ? patch(1, 7) : dem::segment({-1, 0, 0}, {1, 0, 0}), friction));
        block.set_velocity(0, speed * Vector3d::UnitX(), {0, 0, 0});
        const double gain = g * (std::sin(angle) - friction * std::cos(angle));
        const double time = 0.05, stop = gain < 0 ? -speed / gain : 1e9;
        while (block.time() < time)
          block.advance(1);
        const double moved = block.displacement(0).x();
        // The spring of the shear force is stretched first; it gives way by mu F / k_s.
        const double spring = friction * sag * 2, reached = std::min(block.time(), stop);
        CHECK(moved == Approx(speed * reached + 0.5 * gain * reached * reached).margin(spring).epsilon(2e-3));
        if (stop > time)
          CHECK(block.particle(0).velocity.x() == Approx(speed + gain * block.time()).epsilon(2e-3));
        CHECK(block.energy().balance_error() < 1e-4);
        CHECK(block.energy().friction ==
              Approx(friction * mass(dimension) * g * std::cos(angle) * moved).epsilon(5e-3));
      }
}

TEST_CASE("a ball rolls down an incline by 5/7 of the slope, and slides where friction cannot turn it",
          "[dem][facets][slow]")
{
  for (const int dimension : {2, 3})
    {
      const double gyration = dimension == 3 ? 0.4 : 0.5, angle = 0.5;
      const double needed = std::tan(angle) * gyration / (1 + gyration); // of friction, to roll
      for (const double friction : {0.5 * needed, 1.5 * needed})
        {
          const Vector3d          n = up(dimension);
          dem::SpecimenParameters p = loose(dimension);
          p.gravity                 = g * (std::sin(angle) * Vector3d::UnitX() - std::cos(angle) * n);
          const double  sag         = mass(dimension) * g * std::cos(angle) / stiffness(dimension);
          dem::Specimen ball(balls({(R - sag) * n}, R), p, contact());
          ball.surfaces().add(wall(dimension == 3 ? patch(1, 7) : dem::segment({-1, 0, 0}, {1, 0, 0}), friction));
          while (ball.time() < 0.1)
            ball.advance(1);
          const double arm  = R - sag;
          const double gain = friction > needed ? g * std::sin(angle) / (1 + gyration * R * R / (arm * arm)) :
                                                  g * (std::sin(angle) - friction * std::cos(angle));
          const double turn =
            friction > needed ? gain / arm : friction * g * std::cos(angle) * arm / (gyration * R * R);
          const auto state = ball.particle(0);
          CHECK(state.velocity.x() == Approx(gain * ball.time()).epsilon(3e-3));
          CHECK(n.cross(Vector3d::UnitX()).dot(state.spin) == Approx(turn * ball.time()).epsilon(3e-3));
          CHECK(ball.energy().balance_error() < 1e-4);
        }
    }
}

TEST_CASE("a ball rolls over coplanar facets with constant force, and keeps its speed", "[dem][facets]")
{
  dem::SpecimenParameters p = loose();
  p.gravity                 = {0, 0, -g};
  const double  sag         = mass(3) * g / stiffness(3);
  dem::Specimen ball(balls({{-0.08, 0.01, R - sag}}, R), p, contact());
  ball.surfaces().add(wall(patch(0.15, 45), 0.5));
  const Vector3d speed(1, 0.2, 0);
  ball.set_velocity(0, speed, Vector3d::UnitZ().cross(speed) / (R - sag));
  double least = 1e9, largest = 0, sideways = 0;
  while (ball.displacement(0).x() < 0.15)
    {
      ball.advance(1);
      const Vector3d force = ball.surfaces().at(0).total_force;
      least                = std::min(least, -force.z());
      largest              = std::max(largest, -force.z());
      sideways             = std::max(sideways, force.head<2>().norm());
    }
  CHECK(largest - least < 1e-9 * largest); // dozens of edges
  CHECK(sideways <
        1e-4 * largest); // the spin of a step moves its arm by tan(a/2)/(a/2) of the angle a: it settles at once
  CHECK((ball.particle(0).velocity - speed).norm() < 1e-6);
}

TEST_CASE("a ball that is driven over an edge and over a corner at the same distance feels the same force",
          "[dem][facets][slow][S11]")
{
  const double   depth = 1e-4 * R, d = R - depth;
  const Vector3d start(-3 * R, 0.002, d);
  for (const bool corner : {false, true})
    {
      dem::Specimen ball(balls({start}, R), loose(), contact());
      const auto    block = dem::box({-1, corner ? 0.0 : -1.0, -1}, {0, 1, 0}, {true, true, true, true, true, true});
      ball.surfaces().add(wall(block));
      Driven       driven(ball, 0);
      const double way   = corner ? 0.0 : start.y();
      const int    n     = 20000;
      double       least = 1e9, largest = 0, turned = 0;
      Vector3d     before = Vector3d::UnitZ();
      for (int k = 0; k <= n; ++k)
        {
          // along the top, around the edge by a right angle, down the side
          const double t = 6 * R * k / n, top = 3 * R;
          Vector3d     place;
          if (t < top)
            place = {-top + t, way, d};
          else
            {
              const double angle = std::min((t - top) / R, pi / 2);
              place = {d * std::sin(angle), way, d * std::cos(angle) - std::max(0.0, t - top - pi / 2 * R)};
            }
          if (corner)
            place.y() = t < top ? 0.0 : -0.0;
          driven.to(place);
          if (k < 2)
            continue;
          const Vector3d force = -ball.surfaces().at(0).total_force;
          least                = std::min(least, force.norm());
          largest              = std::max(largest, force.norm());
          turned               = std::max(turned, (force.normalized() - before).norm());
          before               = force.normalized();
        }
      CHECK(least == Approx(stiffness(3) * depth).epsilon(1e-6));
      CHECK(largest == Approx(stiffness(3) * depth).epsilon(1e-6));
      CHECK(turned < 1e-3);
    }
}

TEST_CASE("shear goes with a ball from facet to facet: it creeps over edges as over a plane", "[dem][facets]")
{
  std::vector<std::vector<Vector3d>> paths;
  for (const bool plane : {true, false})
    {
      dem::SpecimenParameters p = loose();
      p.gravity                 = {3, 1, -g};
      dem::Specimen ball(balls({{0, 0, R - 2e-6}}, R), p, contact());
      ball.surfaces().add(wall(plane ? dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}) : patch(0.2, 80), 0.25));
      ball.set_velocity(0, {0.3, 0, 0}, {5, 9, 30});
      std::vector<Vector3d> path;
      for (int k = 0; k < 25; ++k)
        {
          ball.advance(200);
          path.push_back(ball.particle(0).position);
        }
      paths.push_back(path);
    }
  CHECK(paths[0].back().norm() > 2.5 * R);
  for (std::size_t k = 0; k < paths[0].size(); ++k)
    CHECK((paths[0][k] - paths[1][k]).norm() < 1e-9 * R);
}
