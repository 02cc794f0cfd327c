#include "closed_system.h"
#include "dem/specimen/specimen.h"
#include "facets_fixture.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

using Eigen::Vector3d;

TEST_CASE("closed system keeps momentum and angular momentum to 1e-12 while it breaks, slides and collides", "[dem]")
{
  omp_set_num_threads(1);
  auto p    = cluster::bonded(1.4);
  p.damping = 0; // local damping is an outer force
  dem::Specimen specimen(cluster::colliding_clusters(60), p, cluster::concrete());
  cluster::set_colliding_velocities(specimen, 20);
  const cluster::Momenta start    = cluster::momenta(specimen);
  std::size_t            contacts = 0;
  for (int n = 0; n < 300; ++n)
    {
      specimen.advance(10);
      contacts                   = std::max(contacts, specimen.counts().contacts);
      const cluster::Momenta now = cluster::momenta(specimen);
      CHECK((now.linear - start.linear).norm() < 1e-12 * now.linear_scale);
      CHECK((now.angular - start.angular).norm() < 1e-12 * now.angular_scale);
    }
  const dem::EnergyAccount energy = specimen.energy();
  CHECK(specimen.counts().broken > 20);
  CHECK(contacts > 3);
  CHECK(energy.friction > 0);
  CHECK(energy.damage > 0);
}

TEST_CASE("energy of a closed system that breaks, slides and collides stays accounted for", "[dem]")
{
  // doc/theory/energy.md: within 1e-3 of the largest term with D = 0 and half the critical step, per 1e4 steps.
  omp_set_num_threads(1);
  for (const double damping : {0.0, 0.3})
    {
      auto p        = cluster::bonded(1.4);
      p.damping     = damping;
      p.step_factor = 0.5;
      dem::Specimen specimen(cluster::colliding_clusters(60), p, cluster::concrete());
      cluster::set_colliding_velocities(specimen, 5);
      dem::EnergyAccount before = specimen.energy();
      for (int n = 0; n < 200; ++n)
        {
          specimen.advance(50);
          const dem::EnergyAccount now = specimen.energy();
          CHECK(now.damage >= before.damage);
          CHECK(now.friction >= before.friction);
          CHECK(now.released >= before.released);
          CHECK(now.damping >= before.damping);
          before = now;
        }
      CHECK(before.external_work == 0);
      CHECK((before.damping > 0) == (damping > 0));
      CHECK(before.balance_error() < 1e-3);
    }
}

TEST_CASE("energy account of a closed system closes to second order in the time step", "[dem]")
{
  omp_set_num_threads(1);
  double error[2];
  for (int finer = 0; finer < 2; ++finer)
    {
      auto p        = cluster::bonded(1.4);
      p.step_factor = finer ? 0.1 : 0.4;
      dem::Specimen specimen(cluster::colliding_clusters(60), p, cluster::concrete());
      cluster::set_colliding_velocities(specimen, 10);
      specimen.advance(finer ? 20000 : 5000);
      error[finer] = specimen.energy().balance_error();
    }
  // 16 for a motion without corners; breaking and touching come at other instants in the other run, hence the wide band.
  CHECK(error[0] / error[1] > 8);
  CHECK(error[1] < 1e-4);
}

namespace
{
  /** A heap of balls of unequal size that are pushed into each other by up to a fifth of a radius, on a lattice shaken sideways. */
  dem::Packing overlapping_balls(const int side)
  {
    constexpr double   R = 0.01;
    dem::Packing       packing;
    dem::UniformRandom random(19);
    for (int k = 0; k < side; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
          {
            packing.centre.push_back(R * (1.8 * Vector3d(i, j, k) + walls::random_place(random, 0.05)));
            packing.radius.push_back(R * (0.85 + 0.15 * random()));
          }
    return packing;
  }

  double residual_part(const dem::EnergyAccount &e) { return std::abs(e.residual()) / e.initial; }
} // namespace

TEST_CASE("balls that overlap at the start push from the first step, and what they store is put into the account",
          "[dem]")
{
  omp_set_num_threads(1);
  const double            R = 0.01, overlap = 0.02 * R, modulus = 1e7;
  dem::SpecimenParameters p = walls::loose();
  p.step_factor             = 0.05; // letting go is of second order in it
  dem::Specimen pair(walls::balls({{0, 0, 0}, {2 * R - overlap, 0, 0}}, R), p, walls::contact(0, modulus));
  const double  stored = 0.5 * modulus * M_PI * R * R / (2 * R) * overlap * overlap; // 1/2 k g^2, k = A E*/(r + r)
  CHECK(pair.energy().initial == Approx(stored).epsilon(1e-10));
  CHECK(pair.energy().elastic == Approx(stored).epsilon(1e-10));
  CHECK(pair.counts().contacts == 0); // no force has been found yet
  pair.advance(1);
  const double force = modulus * M_PI * R * R / (2 * R) * overlap;
  CHECK(pair.particle(1).velocity.x() == Approx(pair.time_step() * force / pair.particle(1).mass).epsilon(1e-9));
  CHECK(residual_part(pair.energy()) < 1e-12);
  CHECK(pair.energy().initial == Approx(stored).epsilon(1e-10));
  pair.advance(1600); // they are apart: all of it moves them
  CHECK(pair.energy().elastic == 0);
  CHECK(pair.energy().kinetic == Approx(stored).epsilon(1e-3));
}

TEST_CASE("energy of a heap of balls that overlap at the start balances, to second order in the step", "[dem]")
{
  omp_set_num_threads(1);
  const auto worst = [](const double factor) {
    dem::SpecimenParameters p = walls::loose();
    p.step_factor             = factor;
    p.damping                 = 0.1;
    dem::Specimen      heap(overlapping_balls(4), p, walls::contact(0.4, 1e6));
    dem::UniformRandom random(3);
    for (std::size_t i = 0; i < heap.counts().particles; ++i)
      heap.set_velocity(i, walls::random_place(random, 0.5), walls::random_place(random, 30));
    double largest = 0;
    while (heap.time() < 0.01)
      {
        heap.advance(1);
        largest = std::max(largest, residual_part(heap.energy()));
      }
    CHECK(heap.energy().friction > 0.02 * heap.energy().initial);
    return largest;
  };
  const double coarse = worst(0.4), fine = worst(0.1);
  INFO(coarse << " " << fine);
  CHECK(coarse < 5e-3);
  CHECK(fine < coarse / 6);
}

TEST_CASE("of a bonded body at rest rounding is no error of the balance", "[dem]")
{
  for (const double damping : {0.0, 0.7})
    {
      auto how    = cluster::bonded(1.2);
      how.damping = damping;
      dem::UniformRandom random(3);
      dem::Packing       packing = cluster::cubic_lattice(5, 4, 3, 0.01);
      for (Eigen::Vector3d &x : packing.centre)
        x += 0.001 * cluster::random_vector(random) + Eigen::Vector3d(0.3, 0.7, 0.1);
      dem::Specimen body(packing, how, cluster::concrete());
      body.advance(3000);
      const dem::EnergyAccount energy = body.energy();
      CHECK(energy.rounding > 0);
      CHECK(energy.balance_error() < 1e-3);
    }
}

TEST_CASE("the largest turn of a particle in a step is noted", "[dem]")
{
  dem::Specimen body(walls::balls({{0, 0, 0}, {0.1, 0, 0}}, 0.01), walls::loose(), walls::contact());
  body.set_velocity(1, Eigen::Vector3d::Zero(), {3, 4, 0});
  body.advance(99);
  CHECK(body.counts().largest_turn == 0); // not checked yet
  body.advance(1);
  CHECK(body.counts().largest_turn == Approx(5 * body.time_step()).epsilon(1e-12));
}
