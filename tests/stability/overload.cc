// Hard case S4: every link of a specimen is overloaded past failure within one step.

#include "dem/specimen/specimen.h"
#include "tests/dem/closed_system.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  /** Link strain per step: a link is deleted at 277 eps_0 = 0.028. */
  constexpr double strain_per_step = 0.06;

  /** Advance step by step; what is dissipated never exceeds what was put in, and no term runs backwards. */
  void fly(dem::Specimen &specimen, const int steps)
  {
    dem::EnergyAccount before;
    for (int n = 0; n < steps; ++n)
      {
        specimen.advance(1); // throws on the first NaN
        const auto e = specimen.energy();
        REQUIRE(e.damage + e.friction + e.released + e.damping <= e.initial);
        REQUIRE(e.kinetic + e.elastic <= e.initial * (1 + 1e-9));
        REQUIRE(e.damage >= before.damage);
        REQUIRE(e.friction >= before.friction);
        REQUIRE(e.released >= before.released);
        before = e;
      }
  }

  void check_momenta(const cluster::Momenta &start, const cluster::Momenta &end)
  {
    CHECK((end.linear - start.linear).norm() < 1e-10 * start.linear_scale);
    CHECK((end.angular - start.angular).norm() < 1e-10 * start.angular_scale);
  }
} // namespace

TEST_CASE("specimen blown apart in one step flies apart in single particles (S4)", "[stability]")
{
  omp_set_num_threads(1);
  const dem::Packing packing = cluster::random_cluster(131, 80, 0.5e-3, 1e-3);
  dem::Specimen      specimen(packing, cluster::bonded(1.5), cluster::concrete());
  const std::size_t  links = specimen.counts().links;
  const double       rate  = strain_per_step / specimen.time_step();
  const Vector3d     still(3e-3, -2e-3, 1e-3); // the point that does not move; not the origin of moments
  for (std::size_t i = 0; i < packing.size(); ++i)
    specimen.set_velocity(i, rate * (packing.centre[i] - still), Vector3d::Zero());
  const double           kinetic = specimen.energy().initial;
  const cluster::Momenta start   = cluster::momenta(specimen);
  specimen.advance(2); // after the first step the links are as they were made
  CHECK(specimen.counts().links == 0);
  CHECK(specimen.counts().broken == links);
  CHECK(specimen.mean_damage() == 1);
  fly(specimen, 300);
  check_momenta(start, cluster::momenta(specimen));
  const auto out = specimen.particles();
  for (std::size_t i = 0; i < packing.size(); ++i) // at failure a link has 1e-4 of its strength left
    CHECK((out.velocity[i] - rate * (packing.centre[i] - still)).norm() < 1e-3 * rate * 1e-3);
  CHECK(specimen.energy().kinetic == Approx(kinetic).epsilon(1e-6));
  CHECK(specimen.energy().damage < 1e-3 * kinetic);
}

TEST_CASE("specimen shaken beyond failure in one step loses no momentum and makes no energy (S4)", "[stability]")
{
  omp_set_num_threads(1);
  for (const double damping : {0.0, 0.3})
    {
      const dem::Packing packing = cluster::random_cluster(132, 80, 0.5e-3, 1e-3);
      auto               p       = cluster::bonded(1.5);
      p.damping                  = damping;
      dem::Specimen      specimen(packing, p, cluster::concrete());
      dem::UniformRandom random(133);
      const double       speed = strain_per_step * 2e-3 / specimen.time_step();
      for (std::size_t i = 0; i < packing.size(); ++i)
        specimen.set_velocity(i, speed * cluster::random_vector(random), speed / 1e-3 * cluster::random_vector(random));
      const cluster::Momenta start = cluster::momenta(specimen);
      const std::size_t      links = specimen.counts().links;
      fly(specimen, 1000);
      if (damping == 0) // local damping is an outer force
        check_momenta(start, cluster::momenta(specimen));
      CHECK(specimen.counts().broken == links);
    }
}
