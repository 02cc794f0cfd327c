// The parts of a specimen by themselves: on particles alone, without links, steps or a specimen around them.
#include "base/errors.h"
#include "dem/specimen/approach_watch.h"
#include "dem/specimen/held_particles.h"
#include "dem/specimen/velocity_kicks.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>

#include <algorithm>

using Eigen::Vector3d;

namespace
{
  constexpr double r = 2e-3;

  /** Spheres of 2 mm in a row along x, this far from each other [m]. */
  dem::Particles row(const std::size_t count, const double apart)
  {
    dem::Packing packing;
    for (std::size_t i = 0; i < count; ++i)
      {
        packing.centre.emplace_back(apart * static_cast<double>(i), 0, 0);
        packing.radius.push_back(r);
      }
    return dem::make_particles(packing, {3, 2500, 0}, true);
  }

  std::vector<std::int32_t> slots_of(const dem::Particles &p)
  {
    std::vector<std::int32_t> slot(p.count);
    for (std::size_t i = 0; i < p.count; ++i)
      slot[static_cast<std::size_t>(p.number[i])] = static_cast<std::int32_t>(i);
    return slot;
  }

  double *six(base::Column &records, const std::int32_t i) { return &records[8 * static_cast<std::size_t>(i)]; }

  double kinetic(const dem::Particles &p)
  {
    double sum = 0;
    for (std::size_t i = 0; i < p.count; ++i)
      for (std::size_t c = 0; c < 6; ++c)
        sum += 0.5 * (c < 3 ? p.mass[i] : p.inertia[i]) * p.velocity[8 * i + c] * p.velocity[8 * i + c];
    return sum;
  }

  dem::Grip clamp(const std::vector<std::size_t> &particles)
  {
    dem::Grip grip;
    grip.particles  = particles;
    grip.prescribed = {true, true, true, true, true, true};
    return grip;
  }
} // namespace

TEST_CASE("The work of a grip's sudden change of velocity is the kinetic energy that it gives", "[dem][parts]")
{
  dem::Particles     p = row(4, 3 * r);
  dem::HeldParticles held;
  const auto         grip = held.add(clamp({3, 1}), slots_of(p), p, 3);
  dem::EnergyFlow    work;
  held.set_rates(grip, Vector3d(0.3, -0.2, 0.1), Vector3d(4, 0, 0), p, &work);
  CHECK(work.at_forces() == Approx(kinetic(p)).epsilon(1e-14));
  REQUIRE(kinetic(p) > 0);
  held.set_own_rates(grip, {Vector3d(1, 0, 0), Vector3d(0, 2, 0)}, {Vector3d::Zero(), Vector3d::Zero()}, p, &work);
  CHECK(work.at_forces() == Approx(kinetic(p)).epsilon(1e-14));
  const auto slot = slots_of(p);
  CHECK(six(p.velocity, slot[3])[0] == 1); // in the order of Grip::particles, whatever that of the particles
  CHECK(six(p.velocity, slot[1])[1] == 2);

  SECTION("but before the first step it is initial energy, and nobody's work")
  {
    dem::HeldParticles others;
    dem::Particles     q = row(4, 3 * r);
    others.set_rates(others.add(clamp({0}), slots_of(q), q, 3), Vector3d(1, 0, 0), Vector3d::Zero(), q, nullptr);
    CHECK(kinetic(q) > 0);
  }
}

TEST_CASE("Only directions that a grip prescribes are held, and react", "[dem][parts]")
{
  dem::Particles p = row(2, 3 * r);
  dem::Grip      grip;
  grip.particles  = {0};
  grip.prescribed = {true, false, false, false, false, true};
  dem::HeldParticles held;
  const auto         slot   = slots_of(p);
  const auto         number = held.add(grip, slot, p, 3);
  held.set_rates(number, Vector3d(5, 6, 7), Vector3d(1, 2, 3), p, nullptr);
  const double *v = six(p.velocity, slot[0]), *mobile = six(p.inverse_mass, slot[0]);
  CHECK(std::vector<double>(v, v + 6) == std::vector<double>{5, 0, 0, 0, 0, 3});
  CHECK((mobile[0] == 0 && mobile[1] > 0 && mobile[4] > 0 && mobile[5] == 0));

  std::copy_n(std::array<double, 6>{10, 20, 30, 1, 2, 3}.data(), 6, six(p.force, slot[0]));
  held.sum_forces(p);
  CHECK(held.reaction(number) == Vector3d(-10, -20, -30));
  // About a point beside it: the prescribed force and couple alone.
  CHECK(held.reaction_moment(p, number, Vector3d(0, 2, 0)).isApprox(Vector3d(0, 0, -10 * 2 - 3), 1e-14));

  dem::EnergyFlow work;
  held.add_work(p, {0.25, 0.5}, work);
  CHECK(work.now == Approx(0.25 * (-10 * 5 - 3 * 3)));
  CHECK(work.after == Approx(0.5 * (-10 * 5 - 3 * 3)));
}

TEST_CASE("Corrections move particles that were left to a partner, and no others", "[dem][parts]")
{
  dem::Particles     p = row(3, 3 * r);
  dem::HeldParticles held;
  const auto         slot  = slots_of(p);
  const auto         lent  = held.add(clamp({2}), slot, p, 3);
  const auto         fixed = held.add(clamp({0}), slot, p, 3);
  const auto         i     = static_cast<std::size_t>(slot[2]);
  CHECK_FALSE(held.correct_rate(p, i, 0, 0, 1));
  held.set_own_rates(lent, {Vector3d::Zero()}, {Vector3d::Zero()}, p, nullptr);
  held.set_rates(fixed, Vector3d::Zero(), Vector3d::Zero(), p, nullptr);
  held.leave_to_partner(lent, p.count);
  const auto energy = held.correct_rate(p, i, 1, 2, 3);
  REQUIRE(energy);
  CHECK(*energy == Approx(0.5 * p.mass[i] * (9 - 4)));
  CHECK_FALSE(held.correct_rate(p, static_cast<std::size_t>(slot[0]), 1, 0, 1));
}

TEST_CASE("A grip's rates for each particle must be as many as it has", "[dem][parts]")
{
  dem::Particles     p = row(3, 3 * r);
  dem::HeldParticles held;
  const auto         grip = held.add(clamp({0, 1}), slots_of(p), p, 3);
  CHECK_THROWS_WITH(held.set_own_rates(grip, {Vector3d::Zero()}, {Vector3d::Zero()}, p, nullptr),
                    Catch::Contains("Grip of 2 particles: velocities of 1 and spins of 1"));
}

TEST_CASE("The state of held particles is whole: a copy that reads it works and reacts alike", "[dem][parts]")
{
  dem::Particles     p = row(3, 3 * r);
  dem::HeldParticles held;
  const auto         slot = slots_of(p);
  held.add(clamp({1}), slot, p, 3);
  dem::HeldParticles copy = held;
  dem::EnergyFlow    work;
  held.set_own_rates(0, {Vector3d(1, 2, 3)}, {Vector3d(4, 5, 6)}, p, &work);
  std::copy_n(std::array<double, 6>{7, 8, 9, 1, 2, 3}.data(), 6, six(p.force, slot[1]));
  held.sum_forces(p);
  MemoryState         memory;
  MemoryState::Writer writer(memory);
  MemoryState::Reader reader(memory);
  held.visit_state(writer);
  copy.visit_state(reader);
  CHECK(copy.reaction(0) == held.reaction(0));
  copy.sum_forces(p); // the power of each particle's own rates follows from these
  dem::EnergyFlow first, second;
  held.add_work(p, {1, 1}, first);
  copy.add_work(p, {1, 1}, second);
  CHECK(first.now == second.now);
  CHECK(first.after == second.after);
  CHECK(first.now == 0); // in the half step before t_n they were still at rest
  CHECK(first.after != 0);
}

TEST_CASE("Kicks count the work of links and weight, not that of a push", "[dem][parts]")
{
  dem::Particles     p = row(2, 3 * r);
  dem::VelocityKicks kicks;
  std::fill_n(six(p.force, 1), 6, 10.0);
  kicks.add(1, {1, 0, 0, 0, 0, 2});
  CHECK(kicks.work(p, 0.5) == Approx(0.5 * 10 * 3));
  p.pushed.assign(p.force.size(), 4.0);
  CHECK(kicks.work(p, 0.5) == Approx(0.5 * 6 * 3));
  kicks.clear();
  CHECK(kicks.work(p, 0.5) == 0);
}

TEST_CASE("Energy that crosses the boundary after the forces are known is accounted for a step later", "[dem][parts]")
{
  dem::EnergyFlow flow{1, 2, 4};
  CHECK(flow.at_forces() == 3);
  flow.next_step();
  CHECK(flow.at_forces() == 7);
  CHECK(flow.after == 0);
}

TEST_CASE("Stiffening contacts cause a new step before overlaps outgrow what the step allows for", "[dem][parts]")
{
  dem::StiffeningWatch watch(1e-5);
  double               path = 0;
  for (int step = 0; step < 1000; ++step)
    {
      const double moved = 1e-7 * (1 + step % 7), allowed = watch.ahead();
      const bool   again = watch.moved(moved);
      path += moved;
      // Not found again: two that approach with the speed of this step are still within what was allowed for.
      if (!again)
        CHECK(2 * (path + moved) <= allowed * (1 + 1e-12));
      else
        path = 0;
      CHECK(watch.ahead() >= 1e-5);
    }
}
