// Balance of walls and driven surfaces: momentum, power, energy, servo, threads, restart, refusals.
#include "base/errors.h"
#include "closed_system.h"
#include "facets_fixture.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>

using namespace walls;
using Catch::Contains;

namespace
{
  constexpr double R = 0.01, modulus = 1e6;

  /** A cloud of balls of unequal size that falls on the surface below it. */
  dem::Packing cloud(const int side, const int layers)
  {
    dem::Packing       packing;
    dem::UniformRandom random(7);
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
          {
            packing.centre.push_back(
              R * (2.6 * Vector3d(i - 0.5 * (side - 1), j - 0.5 * (side - 1), k + 0.6) + random_place(random, 0.25)));
            packing.radius.push_back(R * (0.7 + 0.3 * random()));
          }
    return packing;
  }

  double bumps(const double x, const double y) { return 0.3 * R * std::sin(x / R) * std::cos(0.7 * y / R); }

  /** A cloud flies into a bumpy patch whose vertices somebody else drives, each on its own. */
  struct Clash
  {
    Clash(const double friction, const double factor, const int side = 6)
      : specimen(cloud(side, 2), with(factor), contact(friction, modulus))
    {
      surface             = specimen.surfaces().add(wall(patch(1.7 * side * R, 2 * side, bumps), friction, modulus));
      const std::size_t n = specimen.counts().particles;
      for (std::size_t i = 0; i < n; ++i)
        specimen.set_velocity(i, random_place(random, 0.2) + Vector3d(0.3, 0, -1), random_place(random, 50));
    }
    static dem::SpecimenParameters with(const double factor)
    {
      dem::SpecimenParameters p = loose();
      p.step_factor             = factor;
      return p;
    }
    /** As though it were the boundary of a body that shakes. */
    void drive(const double amount = 0.1)
    {
      const double          t = specimen.time();
      std::vector<Vector3d> velocity;
      for (const Vector3d &x : specimen.surfaces().at(surface).place)
        velocity.push_back(amount *
                           Vector3d(std::sin(300 * t + 40 * x.y()), std::cos(200 * t), std::sin(500 * t + 90 * x.x())));
      specimen.surfaces().set_vertex_velocities(surface, velocity);
    }
    void until(const double time)
    {
      while (specimen.time() < time)
        {
          drive();
          specimen.advance(1);
          most = std::max(most, specimen.surfaces().contacts().size());
        }
    }

    dem::UniformRandom random{11};
    dem::Specimen      specimen;
    std::size_t        surface, most = 0; ///< of contacts at once
  };
} // namespace

TEST_CASE("vertices get what spheres get, turned round: force, moment and power are equal on both sides to 1e-12",
          "[dem][facets][slow]")
{
  Clash  clash(0.4, 0.2);
  int    pressed = 0, powered = 0;
  double worst_force = 0, worst_moment = 0, worst_power = 0;
  while (clash.specimen.time() < 0.03)
    {
      clash.drive();
      clash.specimen.partners().find_surface_forces();
      const dem::Surface &s     = clash.specimen.surfaces().at(clash.surface);
      Vector3d            force = Vector3d::Zero(), moment = Vector3d::Zero();
      double              scale = 0, power = 0, arm = 0.2;
      for (std::size_t v = 0; v < s.place.size(); ++v)
        {
          force += s.force[v];
          moment += s.place[v].cross(s.force[v]);
          power += s.force[v].dot(s.rate[v]);
          scale += s.force[v].norm();
        }
      double power_of_contacts = 0;
      for (const dem::WallContact &contact : clash.specimen.surfaces().contacts())
        {
          force += contact.force;
          moment += contact.place.cross(contact.force);
          // velocity of the surface there, from its facets
          double   nearest = 1;
          Vector3d velocity(0, 0, 0);
          for (std::size_t f = 0; f < s.mesh.size(); ++f)
            {
              const dem::FacetPoint at = dem::closest_on_facet(s.mesh, s.place, f, contact.place);
              if ((at.place - contact.place).norm() < nearest)
                {
                  nearest = (at.place - contact.place).norm();
                  velocity.setZero();
                  for (std::size_t c = 0; c < 3; ++c)
                    velocity += at.weight[c] * s.rate[static_cast<std::size_t>(s.mesh.facet[f][c])];
                }
            }
          if (nearest < 1e-12) // in a hollow it lies a little above the facets
            power_of_contacts += contact.force.dot(velocity);
          else
            power_of_contacts = NAN;
        }
      if (scale > 0)
        {
          ++pressed;
          worst_force  = std::max(worst_force, force.norm() / scale);
          worst_moment = std::max(worst_moment, moment.norm() / (scale * arm));
          if (!std::isfinite(power_of_contacts))
            {
              clash.specimen.advance(1);
              continue;
            }
          ++powered;
          worst_power = std::max(worst_power, std::abs(power + power_of_contacts) / (scale * 0.1));
        }
      clash.specimen.advance(1);
    }
  CHECK(pressed > 100);
  CHECK(powered > pressed / 2);
  CHECK(worst_force < 1e-12);
  CHECK(worst_moment < 1e-12);
  CHECK(worst_power < 1e-12);
}

TEST_CASE("momentum that spheres lose is what the surface took, linear and angular, to round-off",
          "[dem][facets][slow]")
{
  Clash                  clash(0.4, 0.2);
  const cluster::Momenta before = cluster::momenta(clash.specimen);
  clash.until(0.03);
  const cluster::Momenta now = cluster::momenta(clash.specimen);
  const dem::Surface    &s   = clash.specimen.surfaces().at(clash.surface);
  CHECK(s.momentum.norm() > 0.3 * before.linear_scale);
  CHECK((now.linear + s.momentum - before.linear).norm() < 1e-12 * before.linear_scale);
  CHECK((now.angular + s.angular_momentum - before.angular).norm() < 1e-11 * before.angular_scale);
  Vector3d impulses = Vector3d::Zero();
  for (const Vector3d &of_vertex : s.impulse)
    impulses += of_vertex;
  CHECK((impulses - s.momentum).norm() < 1e-12 * before.linear_scale);
}

namespace
{
  double dome(const double x, const double y) { return -2 * (x * x + y * y); }

  /** The same cloud on a dome that is stretched, sheared and shaken: an affine motion, after which few of its edges are hollow. */
  double error_on_dome(const double friction, const double factor)
  {
    dem::Specimen specimen(cloud(6, 2), Clash::with(factor), contact(friction, modulus));
    const auto    surface = specimen.surfaces().add(wall(patch(12 * R, 14, dome), friction, modulus));
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      specimen.set_velocity(i, {0.3, 0, -1}, {10, 30, 20});
    while (specimen.time() < 0.02)
      {
        const double          t = specimen.time() + 0.5 * specimen.time_step();
        std::vector<Vector3d> velocity;
        for (const Vector3d &x : specimen.surfaces().at(surface).place)
          velocity.push_back({2 * x.y() + x.x(), 0.1 * std::sin(300 * t), 0.2 * std::cos(200 * t) + x.x()});
        specimen.surfaces().set_vertex_velocities(surface, velocity);
        specimen.advance(1);
      }
    const dem::EnergyAccount e = specimen.energy();
    CHECK(std::abs(e.external_work) > 1e-2 * e.initial);
    if (friction > 0)
      CHECK(e.friction > 1e-3 * e.initial);
    return e.balance_error();
  }
} // namespace

TEST_CASE("energy of spheres on a driven surface stays accounted for, better with shorter steps", "[dem][facets][slow]")
{
  for (const double friction : {0.0, 0.4})
    {
      const double coarse = error_on_dome(friction, 0.2), fine = error_on_dome(friction, 0.05);
      INFO(coarse << " " << fine);
      CHECK(coarse < 1e-3);
      CHECK(fine < 0.5 * coarse);   // the rest is of the hollow edges
      Clash hollows(friction, 0.2); // there the force is continuous, but not quite the slope of a potential
      hollows.until(0.02);
      CHECK(hollows.specimen.energy().balance_error() < 1e-3);
    }
}

TEST_CASE("energy is closed where a ball starts pressed into a wall, moves, is kicked and steps change",
          "[dem][facets]")
{
  dem::SpecimenParameters p = loose();
  p.gravity                 = {1, 0, -9.81};
  const double  soft = 1e4, sag = 2500 * 4.0 / 3 * pi * R * R * R * 9.81 / (pi * R * soft);
  dem::Specimen ball(balls({{0, 0, R - 1.2 * sag}}, R), p, contact(0.3));
  const auto    floor = ball.surfaces().add(wall(dem::plate({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), 0.01, soft));
  ball.set_velocity(0, {0.05, 0.02, -0.01}, {3, 2, 1});
  ball.surfaces().set_motion(floor, {0.01, 0, 0.005}, {0.1, 0.2, 0.3});
  ball.advance(100);
  ball.partners().apply_impulse(0, {0, 0.01, -0.01}, {0, 1, 0});
  ball.advance(100);
  ball.set_time_step(0.5 * ball.time_step());
  ball.surfaces().set_motion(floor, {0.02, 0, -0.01});
  ball.advance(100);
  ball.partners().add_force(0, {0, 0.001, 0}, {0, 0, 1e-6});
  ball.advance(100);
  CHECK(ball.surfaces().contacts().size() == 1);
  CHECK(ball.energy().friction > 0);
  CHECK(ball.energy().balance_error() < 1e-5);
}

TEST_CASE("a servo brings its wall to the force and holds it there", "[dem][facets][slow]")
{
  dem::SpecimenParameters p = loose();
  p.damping                 = 0.3;
  p.gravity                 = {0, 0, -9.81};
  dem::Packing packing;
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        {
          packing.centre.push_back(R * Vector3d(2.05 * i + 1.02, 2.05 * j + 1.02, 2.05 * k + 1.02));
          packing.radius.push_back(R);
        }
  dem::Specimen bed(packing, p, contact(0.2, 1e6));
  const double  side = 4.1 * R;
  bed.surfaces().add(wall(dem::box({0, 0, 0}, {side, side, 1}, {true, true, true, true, true, false}), 0.2, 1e6));
  const auto piston = bed.surfaces().add(wall(dem::plate({0, 0, 4.5 * R}, {side, 0, 0}, {0, side, 0}), 0, 1e6));
  for (const double force : {20.0, 5.0})
    {
      dem::ForceServo servo;
      servo.direction     = {0, 0, -2};
      servo.force         = force;
      servo.largest_speed = 0.05;
      bed.surfaces().hold_at_force(piston, servo);
      const double end = bed.time() + 0.2;
      while (bed.time() < end)
        bed.advance(100);
      CHECK(bed.surfaces().at(piston).total_force.z() == Approx(force).epsilon(1e-3));
      CHECK(bed.surfaces().at(piston).velocity.norm() < 1e-3);
      CHECK(bed.energy().balance_error() < 1e-3);
      // Below, the box bears the force and the weight.
      double weight = 0;
      for (std::size_t i = 0; i < packing.size(); ++i)
        weight += 9.81 * bed.particle(i).mass;
      CHECK(bed.surfaces().at(0).total_force.z() == Approx(-force - weight).epsilon(5e-3));
    }
}

TEST_CASE("spheres on surfaces move to the same bits with 1 and 2 threads, as a copy, and after a restart",
          "[dem][facets][slow][S13]")
{
  const int  threads = omp_get_max_threads();
  const auto places  = [](const dem::Specimen &s) { return s.particles().position; };
  omp_set_num_threads(1);
  Clash one(0.4, 0.2, 12);
  one.until(0.012);
  CHECK(one.most > 32); // more than one thread has in a piece
  omp_set_num_threads(2);
  Clash two(0.4, 0.2, 12);
  two.until(0.007);
  // A copy, and a new one from the state; both go on.
  Clash       copy(two);
  MemoryState state;
  {
    MemoryState::Writer writer(state);
    two.specimen.visit_state(writer);
  }
  Clash               resumed(0.4, 0.2, 12);
  MemoryState::Reader reader(state);
  resumed.drive();
  resumed.specimen.visit_state(reader);
  two.until(0.012);
  copy.until(0.012);
  resumed.until(0.012);
  omp_set_num_threads(threads);
  for (const Clash *other : {&two, &copy, &resumed})
    {
      CHECK(difference(places(one.specimen), places(other->specimen)) == 0);
      CHECK(one.specimen.energy().residual() == other->specimen.energy().residual());
      CHECK(difference(one.specimen.surfaces().at(0).impulse, other->specimen.surfaces().at(0).impulse) == 0);
    }
}

TEST_CASE("a stiff wall shortens the step of particles that touch it", "[dem][facets]")
{
  dem::Specimen ball(balls({{0, 0, 1.001 * R}}, R), loose(), contact());
  ball.surfaces().add(wall(dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1}), 0.3, 1e10));
  const double before = ball.time_step();
  ball.set_velocity(0, {0, 0, -0.1}, {0, 0, 0});
  while (ball.surfaces().contacts().empty())
    ball.advance(1);
  const double m = ball.particle(0).mass, k = pi * R * 1e10 * std::max(1.0, 0.5 * 3.5);
  CHECK(ball.time_step() < before);
  CHECK(ball.time_step() == Approx(0.2 * std::sqrt(2 * m / k)).epsilon(1e-12));
  CHECK(ball.stable_step() == Approx(std::sqrt(2 * m / k)).epsilon(1e-12));
}

TEST_CASE("stress of a ball between two plates counts what the plates press", "[dem][facets]")
{
  const double  depth = 1e-3 * R;
  dem::Specimen ball(balls({{0, 0, 0}}, R), loose(), contact());
  ball.surfaces().add(wall(dem::FacetMesh::plane({0, 0, depth - R}, {0, 0, 1})));
  ball.surfaces().add(wall(dem::FacetMesh::plane({0, 0, R - depth}, {0, 0, -1})));
  ball.advance(1);
  const auto   out   = ball.particles();
  const double force = pi * R * 1e7 * depth;
  CHECK(out.stress[0](2, 2) == Approx(-2 * force * (R - depth) / out.volume[0]).epsilon(1e-12));
}

TEST_CASE("walls that cannot be are refused by name", "[dem][facets][S14]")
{
  const auto with = [](const Vector3d &centre, const dem::FacetMesh &mesh, const Vector3d &velocity = {0, 0, 0}) {
    dem::Specimen ball(balls({centre}, R), loose(), contact());
    ball.surfaces().add(wall(mesh));
    ball.set_velocity(0, velocity, {0, 0, 0});
    ball.advance(1);
  };
  const auto ground = dem::FacetMesh::plane({0, 0, 0}, {0, 0, 1});
  CHECK_NOTHROW(with({0, 0, 0.6 * R}, ground));
  CHECK_THROWS_WITH(with({0, 0, 0.4 * R}, ground),
                    Contains("surface wall: particle 1 at") && Contains("lies in it by 0.006 m"));
  CHECK_THROWS_WITH(with({0, 0, -9 * R}, ground), Contains("or behind it"));
  CHECK_THROWS_WITH(with({0, 0, 0.1 * R}, dem::plate({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})), Contains("lies in it"));
  CHECK_THROWS_WITH(with({0, 0, 5 * R}, ground, {0, 0, 1e4}), Contains("more than its radius"));
  CHECK_THROWS_AS(with({0, 0, 5 * R}, ground, {0, 0, 1e4}), base::InputError);

  dem::Specimen ball(balls({{0, 0, 2 * R}}, R), loose(), contact());
  const auto    plane = ball.surfaces().add(wall(ground)),
             floor    = ball.surfaces().add(wall(dem::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0})));
  CHECK_THROWS_WITH(ball.surfaces().set_motion(plane, {0, 0, 0}, {0, 1, 0}),
                    Contains("an unbounded plane does not spin"));
  CHECK_THROWS_WITH(ball.surfaces().set_vertex_velocities(plane, {Vector3d(0, 0, 0)}),
                    Contains("do not move one by one"));
  CHECK_THROWS_WITH(ball.surfaces().set_vertex_velocities(floor, {}), Contains("4 vertices: velocities of 0"));
  CHECK_THROWS_WITH(ball.surfaces().hold_at_force(floor, {}), Contains("a servo needs a direction"));
  ball.surfaces().set_motion(plane, {0, 0, 1e6});
  CHECK_THROWS_WITH(ball.advance(1), Contains("more than its radius"));

  dem::Specimen pressed(balls({{0, 0, R}}, R), loose(), contact());
  pressed.surfaces().add(wall(ground, 0, 1e3));
  pressed.set_velocity(0, {0, 0, -10}, {0, 0, 0});
  CHECK_THROWS_WITH(pressed.advance(1000), Contains("particle 1 has sunk into wall wall by its radius"));
}
