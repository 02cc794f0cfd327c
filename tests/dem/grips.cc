#include "clusters.h"
#include "dem/specimen/specimen.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>

using Eigen::Vector3d;

namespace
{
  const double r = 1e-3;

  dem::Grip hold(const std::vector<std::size_t> &particles, const std::array<bool, 6> &prescribed)
  {
    dem::Grip grip;
    grip.particles  = particles;
    grip.prescribed = prescribed;
    return grip;
  }

  constexpr std::array<bool, 6> all = {true, true, true, true, true, true}, along_x = {true}, none = {};
} // namespace

TEST_CASE("grip moves what it prescribes and leaves the rest free", "[dem]")
{
  omp_set_num_threads(1);
  dem::Specimen  specimen(cluster::cubic_lattice(3, 1, 1, r), cluster::elastic(cluster::next_neighbours()),
                          cluster::concrete());
  const auto     tip = specimen.grips().add(hold({2}, along_x));
  const Vector3d free_velocity(7, 0.2, 0);
  specimen.set_velocity(2, free_velocity, Vector3d::Zero());
  specimen.grips().set_velocity(tip, {0.1, 5, 5}, {5, 5, 5});
  specimen.advance(1);
  const auto out = specimen.particles();
  CHECK(out.velocity[2].x() == 0.1);
  CHECK(out.velocity[2].y() == 0.2);
  CHECK(out.angular_velocity[2].norm() == 0);
  CHECK(out.displacement[2].x() == Approx(0.1 * specimen.time_step()).epsilon(1e-10)); // 1e-18 m of rounding
}

TEST_CASE("grips of a stretched bar pull with its stiffness and against each other", "[dem]")
{
  omp_set_num_threads(1);
  const int n = 5;
  auto      p = cluster::elastic(cluster::next_neighbours());
  p.damping   = 0.7;
  dem::Specimen specimen(cluster::cubic_lattice(n, 1, 1, r), p, cluster::concrete());
  const auto    low = specimen.grips().add(hold({0}, all)), high = specimen.grips().add(hold({n - 1}, all));
  const double  stretch = 1e-9;
  specimen.grips().set_velocity(high, {stretch / (1000 * specimen.time_step()), 0, 0}, Vector3d::Zero());
  specimen.advance(1000);
  specimen.grips().set_velocity(high, Vector3d::Zero(), Vector3d::Zero());
  specimen.advance(3000);
  const double k_N   = 25e9 * M_PI * r * r / (2 * r);                // links in series: k_N/(n - 1)
  const double moved = specimen.particles().displacement[n - 1].x(); // each step rounded to coordinates of 1e-18 m
  CHECK(moved == Approx(stretch).epsilon(1e-5));
  CHECK(specimen.grips().reaction(high).x() == Approx(k_N * moved / (n - 1)).epsilon(1e-8));
  CHECK(specimen.grips().reaction(low).x() == Approx(-k_N * moved / (n - 1)).epsilon(1e-8));
}

TEST_CASE("work of grips is what a linear specimen stores and moves with, to round-off", "[dem]")
{
  // The leap-frog energy with v(n-1/2).v(n+1/2) is exact for a bar along a line; grips speed up, stop, and catch free particles.
  omp_set_num_threads(1);
  const int     n = 6;
  dem::Specimen specimen(cluster::cubic_lattice(n, 1, 1, r), cluster::elastic(cluster::next_neighbours()),
                         cluster::concrete());
  specimen.set_velocity(3, {0.1, 0, 0}, Vector3d::Zero());
  specimen.grips().add(hold({0}, all));
  const auto high    = specimen.grips().add(hold({n - 1}, along_x));
  double     largest = 0;
  const auto check   = [&] {
    const auto energy = specimen.energy();
    largest           = std::max(largest, std::abs(energy.residual()) / (energy.kinetic + energy.elastic));
  };
  for (int step = 0; step < 300; ++step)
    {
      const double v = 0.05 * std::sin(0.11 * step);
      specimen.grips().set_velocity(high, {v, 0, 0}, Vector3d::Zero());
      specimen.advance(1);
      check();
    }
  const auto caught = specimen.grips().add(hold({2, 3}, along_x)); // both at their own velocity until now
  for (int step = 0; step < 100; ++step)
    {
      specimen.advance(1);
      check();
    }
  specimen.grips().set_velocity(caught, {-0.02, 0, 0}, Vector3d::Zero());
  specimen.advance(50);
  check();
  CHECK(std::abs(specimen.energy().external_work) > 0.1 * specimen.energy().initial);
  // The elastic energy is that of L - L0, strains of 1e-6 rounded to 1e-16: 1e-10 each step.
  CHECK(largest < 1e-9);
}
