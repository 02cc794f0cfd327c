// Particles that move as one rigid body: doc/theory/clumps.md.
#include "dem/observation/group_motion.h"
#include "facets_fixture.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>

using namespace walls;

namespace
{
  constexpr double R = 0.01;

  /** Three balls in a corner, no axis of symmetry. */
  const std::vector<Vector3d> bent = {{0, 0, 0}, {0.015, 0, 0}, {0.015, 0.018, 0}};

  /** The first three balls of a packing, a body of twice their mass about the mean of their places. */
  dem::RigidClump body_of(const dem::Specimen &specimen)
  {
    dem::RigidClump clump;
    clump.particles = {0, 1, 2};
    for (const std::size_t i : clump.particles)
      {
        clump.mass += 2 * specimen.particle(i).mass;
        clump.centre += specimen.particle(i).position / 3;
      }
    for (const std::size_t i : clump.particles)
      {
        const Vector3d arm = specimen.particle(i).position - clump.centre;
        clump.inertia +=
          clump.mass / 3 * ((0.4 * R * R + arm.squaredNorm()) * Eigen::Matrix3d::Identity() - arm * arm.transpose());
      }
    return clump;
  }

  dem::Specimen
  with_clump(const std::vector<Vector3d> &places, const dem::SpecimenParameters &p, const double friction = 0)
  {
    dem::Specimen made(balls(places, R), p, contact(friction));
    made.clumps().add(body_of(made));
    return made;
  }

  std::vector<Vector3d> bent_and(const Vector3d &further)
  {
    auto places = bent;
    places.push_back(further);
    return places;
  }

  /** Largest change of the distance between two pebbles, over it. */
  double strain_of(const dem::Specimen &specimen)
  {
    double worst = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j)
        {
          const double now = (specimen.particle(i).position - specimen.particle(j).position).norm(),
                       was = (bent[i] - bent[j]).norm();
          worst            = std::max(worst, std::fabs(now / was - 1));
        }
    return worst;
  }
} // namespace

TEST_CASE("a clump that nothing acts on keeps its angular momentum and its shape, and tumbles with its energy",
          "[dem][clumps]")
{
  for (const int dimension : {2, 3})
    {
      dem::Specimen   body  = with_clump(bent, loose(dimension));
      const Vector3d  spin  = dimension == 2 ? Vector3d(0, 0, 300) : Vector3d(300, -100, 200), v(0.3, -0.2, 0);
      dem::RigidClump clump = body_of(dem::Specimen(balls(bent, R), loose(dimension), contact()));
      for (const std::size_t i : clump.particles)
        body.set_velocity(i, v + spin.cross(bent[i] - clump.centre), spin);
      const double          energy   = body.energy().kinetic;
      const dem::ClumpState start    = body.clumps().state(0);
      const Vector3d        momentum = clump.inertia * spin;
      if (dimension == 3)
        CHECK((start.angular_momentum - momentum).norm() <= 1e-14 * momentum.norm());
      CHECK(energy == Approx(0.5 * clump.mass * v.squaredNorm() + 0.5 * spin.dot(clump.inertia * spin)).epsilon(1e-12));
      double least = energy, most = energy;
      for (int block = 0; block < 200; ++block)
        {
          body.advance(100);
          least = std::min(least, body.energy().kinetic);
          most  = std::max(most, body.energy().kinetic);
        }
      const dem::ClumpState now = body.clumps().state(0);
      CHECK((now.angular_momentum - start.angular_momentum).norm() <= 1e-12 * start.angular_momentum.norm());
      CHECK((now.velocity - v).norm() <= 1e-12 * v.norm());
      CHECK((now.position - start.position - body.time() * v).norm() <= 1e-10 * body.time() * v.norm());
      CHECK(strain_of(body) <= 1e-10);
      CHECK(most - least <= (dimension == 2 ? 1e-10 : 1e-4) * energy);
      if (dimension == 2)
        CHECK(now.spin.z() == Approx(spin.z()).epsilon(1e-12));
      else
        CHECK((now.spin - spin).norm() > 0.1 * spin.norm()); // it does tumble
    }
}

TEST_CASE("a clump takes the momentum prescribed to its pebbles, and their angular momentum as far as a body can",
          "[dem][clumps]")
{
  for (const int dimension : {2, 3})
    {
      dem::Packing packing = balls(bent, R);
      packing.radius       = {R, 0.5 * R, 0.7 * R};
      dem::Specimen   body(packing, loose(dimension), contact());
      dem::RigidClump clump;
      clump.particles = {0, 1, 2};
      std::vector<double> mass;
      Vector3d            middle = Vector3d::Zero(); // of the pebbles; the body's own centre lies elsewhere
      double              whole  = 0;
      for (std::size_t i = 0; i < 3; ++i)
        {
          mass.push_back(body.particle(i).mass);
          whole += mass[i];
          middle += mass[i] * bent[i];
        }
      middle /= whole;
      clump.mass    = 3 * whole;
      clump.centre  = middle + Vector3d(1e-3, -2e-3, 0);
      clump.inertia = clump.mass * 1e-4 * Vector3d(1, 2, 3).asDiagonal();
      body.clumps().add(clump);

      const std::vector<Vector3d>          requested = {{0.3, -0.1, 0}, {0.05, 0.2, 0}, {-0.1, 0.4, 0}};
      std::vector<dem::PrescribedVelocity> all;
      for (std::size_t i = 0; i < 3; ++i)
        all.push_back({i, requested[i], Vector3d::Zero(), {true, true, true, false, false, false}});
      body.set_velocities(all);
      const dem::ClumpState found    = body.clumps().state(0);
      Vector3d              momentum = Vector3d::Zero(), there = momentum, turning = momentum, turns = momentum;
      for (std::size_t i = 0; i < 3; ++i)
        {
          const Vector3d rate = found.velocity + found.spin.cross(bent[i] - clump.centre);
          momentum += mass[i] * requested[i];
          there += mass[i] * rate;
          turning += mass[i] * (bent[i] - middle).cross(requested[i]);
          turns += mass[i] * (bent[i] - middle).cross(rate);
          CHECK((body.particles().velocity[i] - rate).norm() < 1e-13);
        }
      CHECK((there - momentum).norm() < 1e-13 * momentum.norm());
      CHECK((turns - turning).norm() < 1e-13 * turning.norm());
      CHECK(found.kinetic_energy() == Approx(0.5 * clump.mass * found.velocity.squaredNorm() +
                                             0.5 * clump.inertia(2, 2) * std::pow(found.spin.z(), 2)));
      CHECK(body.energy().kinetic == Approx(found.kinetic_energy()).epsilon(1e-13));
    }
}

TEST_CASE("a clump of which one component of a turn is prescribed turns as a whole, and so it does by its spin",
          "[dem][clumps]")
{
  const Vector3d spin(0, 0, 80);
  for (const bool by_spin : {false, true})
    {
      dem::Specimen                        body   = with_clump(bent, loose(3));
      const Vector3d                       centre = body.clumps().state(0).position;
      std::vector<dem::PrescribedVelocity> requested;
      for (std::size_t i = 0; i < 3; ++i)
        requested.push_back(by_spin ? dem::PrescribedVelocity{i, {}, spin, {false, false, false, false, false, true}} :
                                      dem::PrescribedVelocity{i, spin.cross(bent[i] - centre), {}, {false, true}});
      body.set_velocities(requested);
      CHECK((body.clumps().state(0).spin - spin).norm() < 1e-12 * spin.norm());
      CHECK(body.clumps().state(0).velocity.norm() < 1e-13);
    }
}

TEST_CASE("a group counts the bodies that lie in it whole as bodies, and of others the pebbles", "[dem][clumps]")
{
  dem::Specimen         both = with_clump(bent_and({0.1, 0, 0}), loose(3));
  const dem::ClumpState body = both.clumps().state(0);
  const double          ball = both.particle(3).mass, speed = 0.4;
  const Vector3d        spin(3, -2, 5);
  for (std::size_t i = 0; i < 3; ++i)
    both.set_velocity(i, spin.cross(bent[i] - body.position), spin);
  both.set_velocity(3, {speed, 0, 0}, Vector3d::Zero());
  both.advance(1000);
  const dem::ParticleOutput seen = both.particles();
  const dem::ClumpState     now  = both.clumps().state(0);
  const dem::GroupMotion whole = dem::motion_of(both, seen, {0, 1, 2}), all = dem::motion_of(both, seen, {0, 1, 2, 3}),
                         part = dem::motion_of(both, seen, {1, 2});
  CHECK(whole.mass == Approx(body.mass).epsilon(1e-14));
  CHECK((whole.position - now.position).norm() < 1e-15);
  CHECK((whole.travelled - now.travelled).norm() < 1e-15);
  CHECK(whole.kinetic_energy == Approx(0.5 * now.spin.dot(now.angular_momentum)).epsilon(1e-12));
  CHECK(all.kinetic_energy == Approx(whole.kinetic_energy + 0.5 * ball * speed * speed).epsilon(1e-12));
  const Vector3d centre = (body.mass * now.position + ball * seen.position[3]) / (body.mass + ball);
  CHECK((all.position - centre).norm() < 1e-15);
  CHECK((part.position - 0.5 * (seen.position[1] + seen.position[2])).norm() < 1e-15);
  CHECK(part.mass == Approx(2.0 / 3 * body.mass).epsilon(1e-14));
}

TEST_CASE("a clump answers a force through its centre as one mass, and beside it as its inertia says", "[dem][clumps]")
{
  for (const int dimension : {2, 3})
    {
      dem::Specimen         body  = with_clump(bent, loose(dimension));
      const dem::RigidClump clump = body_of(dem::Specimen(balls(bent, R), loose(dimension), contact()));
      // One force on each pebble: their resultant passes the centre. Another at the last one alone.
      const Vector3d push(0.02, 0.01, 0), aside(0, 1e-4, 0);
      for (const std::size_t i : clump.particles)
        body.partners().add_force(i, push, Vector3d::Zero());
      body.advance(1000);
      const Vector3d speed = 3 * body.time() / clump.mass * push; // kicks and drifts have taken the same time
      CHECK((body.clumps().state(0).velocity - speed).norm() <= 1e-9 * speed.norm());
      CHECK(body.clumps().state(0).spin.norm() <= 1e-9);
      CHECK(body.energy().balance_error() < 1e-10);
      body.partners().clear_forces();
      const Vector3d before = body.clumps().state(0).angular_momentum;
      body.partners().add_force(2, aside, Vector3d::Zero());
      body.advance(1);
      const double couple = (bent[2] - clump.centre).cross(aside).z();
      CHECK((body.clumps().state(0).angular_momentum - before).z() == Approx(couple * body.time_step()).epsilon(1e-6));
      CHECK(body.clumps().state(0).spin.z() * clump.inertia(2, 2) == Approx(couple * body.time_step()).epsilon(1e-6));
    }
}

TEST_CASE("a ball that hits a clump: momentum, angular momentum and energy of both stay", "[dem][clumps]")
{
  for (const int dimension : {2, 3})
    {
      const Vector3d          at(0.02, 0.0391, 0), speed(0.05, -0.8, 0);
      dem::SpecimenParameters p   = loose(dimension);
      p.step_factor               = 0.02; // a contact is born between two steps: of second order, as between balls
      dem::Specimen         both  = with_clump(bent_and(at), p);
      const dem::RigidClump clump = body_of(dem::Specimen(balls(bent_and(at), R), p, contact()));
      both.set_velocity(3, speed, Vector3d::Zero());
      const dem::ParticleState ball   = both.particle(3);
      const Vector3d           linear = ball.mass * speed, angular = at.cross(linear);
      both.advance(1);
      double touched = 0;
      for (int block = 0; block < 60; ++block)
        {
          both.advance(500);
          touched = std::max(touched, both.energy().elastic);
        }
      CHECK(touched > 0.1 * 0.5 * ball.mass * speed.squaredNorm());
      const dem::ParticleState after = both.particle(3);
      const dem::ClumpState    body  = both.clumps().state(0);
      CHECK((after.mass * after.velocity + clump.mass * body.velocity - linear).norm() <= 1e-12 * linear.norm());
      // Places are at t_n, velocities half a step before: along a free flight that makes no difference.
      const Vector3d sum = after.position.cross(after.mass * after.velocity) + after.inertia * after.spin +
                           body.position.cross(clump.mass * body.velocity) + body.angular_momentum;
      CHECK((sum - angular).z() / angular.z() == Approx(0).margin(1e-9));
      CHECK(std::fabs(body.spin.z()) > 1);
      CHECK(both.energy().elastic == 0);
      CHECK(both.energy().balance_error() < 1e-5);
      CHECK(strain_of(both) <= 1e-11);
    }
}

TEST_CASE("a clump comes to rest on the ground, which then bears its weight", "[dem][clumps]")
{
  for (const int dimension : {2, 3})
    {
      const Vector3d          up = dimension == 2 ? Vector3d::UnitY() : Vector3d::UnitZ();
      dem::SpecimenParameters p  = loose(dimension);
      p.gravity                  = -9.81 * up;
      p.damping                  = 0.5;
      auto places                = bent;
      for (Vector3d &place : places)
        place += 1.01 * R * up;
      dem::Specimen         body(balls(places, R), p, contact(0.4));
      const dem::RigidClump clump = body_of(body);
      body.clumps().add(clump);
      body.surfaces().add(wall(dem::FacetMesh::plane({0, 0, 0}, up), 0.4));
      while (body.time() < 0.6)
        body.advance(100);
      CHECK(body.surfaces().at(0).total_force.dot(up) == Approx(-clump.mass * 9.81).epsilon(1e-6));
      CHECK(body.clumps().state(0).velocity.norm() < 1e-7);
      CHECK(body.energy().balance_error() < 1e-3);
      CHECK(strain_of(body) <= 1e-11);
    }
}

TEST_CASE("clumps move to the same bits with any number of threads, and after a restart", "[dem][clumps]")
{
  dem::SpecimenParameters p = loose(3);
  p.gravity                 = {0, 0, -9.81};
  p.damping                 = 0.1;
  const auto made           = [&p] {
    dem::Specimen body = with_clump(bent_and({0.011, 0.008, 0.0199}), p, 0.3);
    body.surfaces().add(wall(dem::FacetMesh::plane({0, 0, -0.0101}, {0, 0, 1}), 0.3));
    return body;
  };
  const auto run = [&](const int threads, const bool restart) {
    omp_set_num_threads(threads);
    dem::Specimen body = made();
    body.advance(2000);
    dem::Specimen fresh = made();
    if (restart)
      {
        MemoryState         memory;
        MemoryState::Writer writer(memory);
        body.visit_state(writer);
        MemoryState::Reader reader(memory);
        fresh.visit_state(reader);
      }
    dem::Specimen &on = restart ? fresh : body;
    on.advance(2000);
    std::vector<double> all = {on.energy().kinetic, on.energy().friction, on.energy().damping};
    for (std::size_t i = 0; i < 4; ++i)
      for (int c = 0; c < 3; ++c)
        all.push_back(on.particle(i).position[c]);
    return all;
  };
  const auto once = run(1, false);
  CHECK(once == run(2, false));
  omp_set_num_threads(1);
  CHECK(once == run(1, true));
}

TEST_CASE("a clump that is none is refused, and so is what would hold a part of one", "[dem][clumps]")
{
  dem::Specimen         body(balls(bent_and({0.1, 0, 0}), R), loose(3), contact());
  const dem::RigidClump clump   = body_of(body);
  const auto            refused = [&body](const dem::RigidClump &given, const char *words) {
    CHECK_THROWS_WITH(body.clumps().add(given), Catch::Contains(words));
  };
  dem::RigidClump wrong = clump;
  wrong.particles.clear();
  refused(wrong, "has no particle");
  wrong      = clump;
  wrong.mass = 0;
  refused(wrong, "mass of 0 kg");
  wrong         = clump;
  wrong.inertia = -clump.inertia;
  refused(wrong, "inertia");
  body.clumps().add(clump);
  refused(clump, "pebble of another clump");
  dem::Grip grip;
  grip.particles = {1};
  CHECK_THROWS_WITH(body.grips().add(grip), Catch::Contains("pebble"));
  body.advance(1);
  refused(clump, "before the first step");
}
