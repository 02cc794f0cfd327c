// Balls whose centres go through a surface: doc/theory/facets.md, 5 and 6.
#include "facets_fixture.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

using namespace walls;
using Catch::Contains;

namespace
{
  constexpr double R = 0.01;

  double stiffness(const int dimension) { return dimension == 3 ? pi * R * 1e7 : 2 * 0.01 * 1e7; }
  double mass(const int dimension) { return 2500 * (dimension == 3 ? 4.0 / 3 * pi * R * R * R : pi * R * R * 0.01); }
  double omega(const int dimension) { return std::sqrt(stiffness(dimension) / mass(dimension)); }

  /** A closed surface, or a part of one, around a place. */
  dem::FacetMesh bounding(dem::FacetMesh mesh, const Vector3d &within)
  {
    for (const auto &facet : mesh.facet)
      {
        const auto corner = [&](const std::size_t c) { return mesh.vertex[static_cast<std::size_t>(facet[c])]; };
        mesh.outward.push_back(
          dem::facet_normal({{corner(0), corner(1), corner(2)}}, mesh.corners == 2).dot(corner(0) - within) > 0 ? 1 :
                                                                                                                  -1);
      }
    return mesh;
  }

  dem::FacetMesh block(const int dimension)
  {
    const Vector3d       low(-0.1, -0.1, dimension == 3 ? -0.1 : 0), high(0.1, 0.1, dimension == 3 ? 0.1 : 0);
    const dem::FacetMesh sides = dimension == 3 ? dem::box(low, high, {true, true, true, true, true, true}) :
                                                  dem::rectangle(low, high, {true, true, true, true, true, true});
    return bounding(sides, {0, 0, 0});
  }

  Vector3d up(const int dimension) { return dimension == 3 ? Vector3d::UnitZ() : Vector3d::UnitY(); }

  /** A ball that comes from above, so fast that it would sink in by so many radii. */
  dem::Specimen falling(const int dimension, const Vector3d &at, const double radii)
  {
    dem::Specimen ball(balls({at}, R), loose(dimension), contact());
    ball.set_velocity(0, -radii * R * omega(dimension) * up(dimension), {0, 0, 0});
    return ball;
  }
} // namespace

TEST_CASE("no centre goes through a wall unnoticed", "[dem][facets]")
{
  for (const int dimension : {2, 3})
    {
      // Over a face, over the diagonal between two, and over a corner that several have.
      for (const Vector3d &beside : {Vector3d(0.003, 0.001, 0), Vector3d(0.02, 0.02, 0), Vector3d(0, 0, 0)})
        {
          const Vector3d       at   = dimension == 3 ? beside + R * Vector3d::UnitZ() : Vector3d(beside.x(), R, 0);
          const dem::FacetMesh mesh = dimension == 3 ? patch(
                                                         0.1, 2, [](double, double) { return 0.0; }, 0) :
                                                       dem::segment({-0.1, 0, 0}, {0.1, 0, 0});
          dem::Specimen        ball = falling(dimension, at, 1.5);
          ball.surfaces().add(wall(mesh));
          CHECK_THROWS_WITH(ball.advance(1000), Contains("particle 1 has sunk into wall wall by its radius"));
          CHECK(ball.particle(0).position.dot(up(dimension)) < 0.1 * R); // not before

          dem::Specimen rests = falling(dimension, at, 0);
          rests.surfaces().set_motion(rests.surfaces().add(wall(mesh)), 3 * R * omega(dimension) * up(dimension),
                                      {0, 0, 0});
          CHECK_THROWS_WITH(rests.advance(1000), Contains("particle 1 has sunk into wall wall by its radius"));
        }
    }
  for (const bool skin : {true, false})
    {
      // Pressure on areas and footprints know no inside either.
      dem::Specimen          ball = falling(3, {0.003, 0.001, R}, 3);
      dem::SurfaceParameters body = wall(block(3));
      for (Vector3d &x : body.mesh.vertex)
        x.z() -= 0.1;
      body.skin   = skin ? R : 0;
      body.spread = !skin;
      ball.surfaces().add(body);
      CHECK_THROWS_WITH(ball.advance(1000), Contains("particle 1 has sunk into wall wall by its radius"));
    }
}

TEST_CASE("a ball that passes a wall by, in steps as long as itself, is not taken for one that goes through",
          "[dem][facets]")
{
  dem::Specimen ball(balls({{-5 * R, 0, 0.3 * R}}, R), loose(), contact(0, 1e-3));
  ball.surfaces().add(wall(dem::plate({0, -1, -1}, {0, 2, 0}, {0, 0, 1}), 0, 1e-3)); // its edge is the axis y
  ball.set_time_step(1e-3);
  ball.set_velocity(0, {0.9 * R / 1e-3, 0, 0}, {0, 0, 0});
  CHECK_NOTHROW(ball.advance(12));
  CHECK(ball.particle(0).position.x() > 5 * R);
}

TEST_CASE("facets that bound a body push a ball out of it whose centre has sunk in, with its speed", "[dem][facets]")
{
  for (const int dimension : {2, 3})
    for (const Vector3d &beside : {Vector3d(0.003, 0.001, 0), Vector3d(0.02, 0.02, 0)})
      {
        const Vector3d n    = up(dimension);
        const Vector3d at   = (dimension == 3 ? beside : Vector3d(beside.x(), 0, 0)) + (0.1 + R) * n;
        dem::Specimen  ball = falling(dimension, at, 1.6);
        ball.surfaces().add(wall(block(dimension)));
        const int steps = 150;
        ball.set_time_step(2 / omega(dimension) *
                           std::sin(pi / (2 * steps))); // leap-frog takes exactly so many to turn
        ball.advance(steps / 2);
        CHECK(ball.particle(0).position.dot(n) == Approx(0.1 - 0.6 * R).epsilon(1e-3));
        REQUIRE(ball.surfaces().contacts().size() == 1);
        CHECK(ball.surfaces().contacts().front().overlap == Approx(1.6 * R).epsilon(1e-3));
        CHECK(ball.energy().balance_error() < 1e-12);

        MemoryState state;
        {
          MemoryState::Writer writer(state);
          ball.visit_state(writer);
        }
        dem::Specimen resumed = falling(dimension, at, 1.6);
        resumed.surfaces().add(wall(block(dimension)));
        resumed.set_time_step(ball.time_step());
        MemoryState::Reader reader(state);
        resumed.visit_state(reader);
        for (dem::Specimen *goes_on : {&ball, &resumed})
          {
            goes_on->advance(steps / 2 + 1);
            CHECK(goes_on->particle(0).velocity.dot(n) == Approx(1.6 * R * omega(dimension)).epsilon(1e-10));
            CHECK(goes_on->energy().balance_error() < 1e-12);
          }
        CHECK(difference({ball.particle(0).position}, {resumed.particle(0).position}) == 0);
      }
}

TEST_CASE("a ball that sinks into a body by twice its radius is refused", "[dem][facets]")
{
  dem::Specimen ball = falling(3, {0.003, 0.001, 0.1 + R}, 3);
  ball.surfaces().add(wall(block(3)));
  CHECK_THROWS_WITH(ball.advance(1000), Contains("particle 1 has sunk into wall wall by twice its radius"));
}

TEST_CASE("a ball that sinks into a dent by more than its radius keeps momentum, moments and nearly its energy",
          "[dem][facets]")
{
  // A dent of a third of the radius, under the side of the ball.
  const auto dent = [](const double x, const double y) { return -0.3 * R * std::exp(-(x * x + y * y) / (R * R)); };
  for (const Vector3d &at : {Vector3d(0, 0, R), Vector3d(0.3 * R, 0.1 * R, R), Vector3d(R, -0.4 * R, R)})
    {
      dem::Specimen ball = falling(3, at, 1.5);
      ball.surfaces().add(wall(bounding(patch(4 * R, 12, dent), {0, 0, -1}), 0.2));
      const double start = ball.energy().kinetic, step = 0.02 / omega(3);
      double       most     = 0;
      Vector3d     momentum = ball.particle(0).mass * ball.particle(0).velocity;
      ball.set_time_step(step);
      for (int n = 0; n < 250; ++n)
        {
          ball.advance(1);
          most = std::max(most, std::fabs(ball.energy().residual()));
        }
      CHECK(ball.surfaces().contacts().empty());
      const dem::ParticleState p = ball.particle(0);
      momentum -= p.mass * p.velocity;
      const dem::Surface &s = ball.surfaces().at(0);
      CHECK((momentum - s.momentum).norm() < 1e-12 * momentum.norm());
      CHECK(p.velocity.z() > 0);
      CAPTURE(at.transpose());
      CHECK(most < 0.03 * start);
    }
}
