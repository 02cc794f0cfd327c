// Weight in motion: free fall, sudden load, energy, restart, threads.
#include "base/errors.h"
#include "clusters.h"
#include "dem/specimen/specimen.h"
#include "memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3;

  dem::Grip held(const std::vector<std::size_t> &particles)
  {
    dem::Grip grip;
    grip.particles  = particles;
    grip.prescribed = {true, true, true, true, true, true};
    return grip;
  }

  /** A row of spheres along z that hangs from its first one. */
  dem::Specimen hanging_row(const int free, dem::SpecimenParameters p, const double g)
  {
    p.gravity = {0, 0, g};
    dem::Specimen specimen(cluster::cubic_lattice(1, 1, free + 1, r), cluster::elastic(p), cluster::concrete());
    specimen.grips().add(held({0}));
    return specimen;
  }

  /** Largest displacement of the last sphere over what its links stretch at rest. */
  double dynamic_factor(const int free)
  {
    const double g        = 1e3;
    auto         p        = cluster::next_neighbours();
    p.step_factor         = 0.1;
    auto         specimen = hanging_row(free, p, g);
    const double mass = p.density * 4.0 / 3 * M_PI * r * r * r, k = 25e9 * M_PI * r * r / (2 * r);
    const double at_rest = mass * g / k * free * (free + 1) / 2;
    double       largest = 0;
    const double period  = 4 * (free + 0.5) * std::sqrt(mass / k); // of a bar as long: four passages of a wave
    while (specimen.time() < period)
      {
        specimen.advance(1);
        largest = std::max(largest, specimen.particles().displacement[free].z());
      }
    return largest / at_rest;
  }
} // namespace

TEST_CASE("a free body falls as one: v = g t", "[dem][gravity]")
{
  omp_set_num_threads(2);
  const Vector3d g(1.3, -0.4, -9.81);
  auto           p = cluster::next_neighbours();
  p.gravity        = g;
  dem::Specimen specimen(cluster::random_cluster(5, 300, 0.5e-3, 1e-3), p, cluster::concrete());
  specimen.advance(5000);
  const double   t        = specimen.time();
  const auto     out      = specimen.particles();
  const Vector3d fall     = 0.5 * g * t * (t + specimen.time_step()); // of the leap-frog, from rest half a step before
  Vector3d       momentum = Vector3d::Zero();
  double         mass     = 0;
  for (std::size_t i = 0; i < out.position.size(); ++i)
    {
      // Coordinates of 1e-3 m are rounded to 1e-19 m, which links of 1e7 N/m take for 1e-12 N: 1e-7 of a weight, to and fro.
      CHECK((out.velocity[i] - t * g).norm() < 1e-8 * t * g.norm());
      CHECK((out.displacement[i] - fall).norm() < 1e-8 * fall.norm());
      momentum += std::pow(out.radius[i], 3) * out.velocity[i];
      mass += std::pow(out.radius[i], 3);
    }
  CHECK((momentum / mass - t * g).norm() < 1e-12 * t * g.norm()); // links push both ways alike
  CHECK(specimen.counts().broken == 0);
  const dem::EnergyAccount energy = specimen.energy();
  CHECK(energy.gravity > 0);
  CHECK(energy.kinetic == Approx(energy.gravity).epsilon(1e-9));
  CHECK(energy.balance_error() < 1e-9);
}

TEST_CASE("sudden gravity stretches twice as far as the same weight at rest", "[dem][gravity]")
{
  omp_set_num_threads(1);
  // One sphere on a spring: 1 - cos, sampled by steps of 0.1 of the critical one.
  CHECK(dynamic_factor(1) == Approx(2).epsilon(1e-3));
  // A bar: all its frequencies are odd multiples of the first. Those of a row of spheres are not quite.
  CHECK(dynamic_factor(40) == Approx(2).epsilon(0.03));
}

TEST_CASE("energy with weight balances, with and without damping, damage and grips that lift", "[dem][gravity]")
{
  omp_set_num_threads(2);
  for (const double damping : {0.0, 0.3})
    for (const double g : {200.0, 2e5}) // elastic; breaking off
      {
        auto p        = cluster::bonded(1.5);
        p.gravity     = {0.2 * g, 0, -g};
        p.damping     = damping;
        p.step_factor = 0.1;
        dem::Specimen specimen(cluster::random_cluster(8, 150, 0.7e-3, 1e-3), p, cluster::concrete());
        const auto    grip = specimen.grips().add(held({0, 1, 2}));
        specimen.grips().set_velocity(grip, {0, 0, 0.01}, Vector3d::Zero());
        double worst = 0;
        for (int sample = 0; sample < 40; ++sample)
          {
            specimen.advance(100);
            worst = std::max(worst, specimen.energy().balance_error());
          }
        INFO("damping " << damping << ", gravity " << g << ", broken " << specimen.counts().broken);
        CHECK(worst < (g > 1e3 ? 1e-3 : 1e-6));
        CHECK((specimen.counts().broken > 0) == (g > 1e3));
        CHECK(std::abs(specimen.energy().external_work) > 0);
      }
}

TEST_CASE("the force ratio of what falls is one, and of what stands the sum of forces on it knows its weight",
          "[dem][gravity]")
{
  auto how    = cluster::bonded(1.05);
  how.gravity = {0, 0, -9.81};
  how.damping = 0.7;
  // Two spheres, one above the other: both fall freely.
  const dem::Packing pair = {{{0, 0, 0.01}, {0, 0, 0.03}}, {0.01, 0.01}, {}};
  dem::Specimen      falls(pair, how, cluster::concrete());
  falls.advance(1);
  CHECK(falls.force_ratio() == Approx(1).epsilon(1e-9));
  // The lower one held: of the upper one's weight all is borne by the link, and its forces are twice its weight.
  dem::Specimen stands(pair, how, cluster::concrete());
  dem::Grip     foot;
  foot.particles  = {0};
  foot.prescribed = {true, true, true, true, true, true};
  stands.grips().add(foot);
  stands.advance(1);
  CHECK(stands.force_ratio() == Approx(1).epsilon(1e-9)); // nothing bears it yet
  stands.advance(3);
  const double weight = stands.particle(1).mass * 9.81, borne = stands.links().normal_force.at(0);
  CHECK(stands.force_ratio() == Approx(std::abs(weight + borne) / (weight + std::abs(borne))).epsilon(1e-9));
}

TEST_CASE("grips carry the weight of their own particles too", "[dem][gravity]")
{
  omp_set_num_threads(1);
  auto p                = cluster::next_neighbours();
  p.gravity             = {0, 0, -10};
  const auto    packing = cluster::cubic_lattice(2, 1, 1, r);
  dem::Specimen specimen(packing, cluster::elastic(p), cluster::concrete());
  const auto    grip = specimen.grips().add(held({0, 1}));
  specimen.advance(1);
  CHECK(specimen.grips().reaction(grip).z() == Approx(2 * p.density * 4.0 / 3 * M_PI * r * r * r * 10).epsilon(1e-14));
}

TEST_CASE("with weight a run goes on from its state to the same bits, on any number of threads", "[dem][gravity]")
{
  auto p             = cluster::bonded(1.5);
  p.gravity          = {0, 3e4, -1e5};
  p.damping          = 0.2;
  const auto packing = cluster::random_cluster(9, 700, 0.7e-3, 1e-3);
  const auto make    = [&] {
    dem::Specimen specimen(packing, p, cluster::concrete());
    specimen.grips().add(held({0, 1, 2, 3}));
    return specimen;
  };
  const auto state_of = [](dem::Specimen &specimen) {
    MemoryState         state;
    MemoryState::Writer writer(state);
    specimen.visit_state(writer);
    return state;
  };
  omp_set_num_threads(1);
  auto whole = make();
  whole.advance(300);
  MemoryState half = state_of(whole);
  whole.advance(300);
  REQUIRE(whole.counts().broken > 0);

  omp_set_num_threads(3);
  auto                resumed = make();
  MemoryState::Reader reader(half);
  resumed.visit_state(reader);
  resumed.advance(300);
  CHECK(state_of(resumed) == state_of(whole));
  CHECK(resumed.energy().gravity == whole.energy().gravity);
}

TEST_CASE("gravity without sense is refused", "[dem][gravity]")
{
  const auto refusal = [](const auto &change) {
    auto p = cluster::next_neighbours();
    change(p);
    dem::Packing packing  = cluster::cubic_lattice(3, 3, 1, r);
    packing.periodic_cell = Vector3d::Constant(6 * r);
    dem::Specimen(packing, p, cluster::concrete());
  };
  using P = dem::SpecimenParameters;
  CHECK_THROWS_WITH(refusal([](P &p) { p.gravity.x() = std::numeric_limits<double>::quiet_NaN(); }),
                    Catch::Contains("Gravity: must be finite"));
  CHECK_THROWS_WITH(refusal([](P &p) {
                      p.gravity.x()      = 1;
                      p.physics.periodic = true;
                    }),
                    Catch::Contains("periodic cell"));
  CHECK_THROWS_WITH(refusal([](P &p) {
                      p.gravity.z()       = 1;
                      p.thickness         = 1;
                      p.physics.dimension = 2;
                    }),
                    Catch::Contains("in the plane"));
}
