// Hard case S13: a restart in the middle of a damaging run, and the same run with 1, 2 and 4 threads, to the last bit.

#include "dem/loading/uniaxial.h"
#include "dem/specimen/specimen.h"
#include "tests/dem/closed_system.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <memory>

using Eigen::Vector3d;

namespace
{
  /** Everything that a run remembers. */
  MemoryState state_of(dem::Specimen &specimen)
  {
    MemoryState         memory;
    MemoryState::Writer writer(memory);
    specimen.visit_state(writer);
    return memory;
  }

  void check_same(MemoryState &a, MemoryState &b)
  {
    REQUIRE(a.numbers.size() == b.numbers.size());
    for (const auto &[name, value] : a.numbers)
      {
        INFO(name);
        CHECK(value == b.numbers.at(name));
      }
    CHECK(a.integers == b.integers);
    for (const auto &[name, column] : a.columns)
      {
        INFO(name);
        CHECK(column == b.columns.at(name));
      }
    for (const auto &[name, column] : a.integer_columns)
      {
        INFO(name);
        CHECK(column == b.integer_columns.at(name));
      }
  }

  struct Choice
  {
    int    dimension;
    double shear_contribution, damping;
  };

  /** Two clusters that break each other, one of them held in a moving grip. */
  std::unique_ptr<dem::Specimen> make(const Choice &choice)
  {
    auto p                      = cluster::bonded(1.4);
    p.damping                   = choice.damping;
    p.physics.dimension         = choice.dimension;
    p.thickness                 = 1e-3;
    auto material               = cluster::concrete();
    material.shear_contribution = choice.shear_contribution;
    dem::Packing packing        = cluster::colliding_clusters(300);
    if (choice.dimension == 2)
      packing = cluster::cubic_lattice(24, 24, 1, 1e-3);
    auto specimen = std::make_unique<dem::Specimen>(packing, p, material);
    if (choice.dimension == 3)
      cluster::set_colliding_velocities(*specimen, 120);
    else
      for (std::size_t i = 0; i < packing.size(); ++i) // torn across the middle, the rest pushed together
        specimen->set_velocity(i, {packing.centre[i].x() < 23e-3 ? -60.0 : 60.0, 2e3 * packing.centre[i].x(), 0},
                               {0, 0, 1e4});
    dem::Grip grip;
    grip.particles     = {0, 5, 17};
    grip.prescribed[0] = grip.prescribed[4] = true;
    grip.velocity                           = {5, 0, 0};
    specimen->grips().add(grip);
    return specimen;
  }

  /** Steps 1 to 100, a change of the grip's velocity, steps 101 to 220. */
  void first_part(dem::Specimen &specimen)
  {
    specimen.advance(100);
    specimen.grips().set_velocity(0, {-40, 0, 0}, {0, 3, 0}); // its impulse is part of what must be remembered
  }

  void second_part(dem::Specimen &specimen) { specimen.advance(120); }
} // namespace

TEST_CASE("run restarted in the middle of damage goes on to the same bits with 1, 2 and 4 threads (S13)", "[stability]")
{
  for (const Choice &choice : {Choice{3, 0.0, 0.1}, Choice{3, 0.5, 0.0}, Choice{2, 0.0, 0.1}})
    {
      INFO(choice.dimension << "D, xi " << choice.shear_contribution << ", damping " << choice.damping);
      omp_set_num_threads(1);
      const auto through = make(choice);
      first_part(*through);
      MemoryState middle = state_of(*through);
      second_part(*through);
      MemoryState end = state_of(*through);
      CHECK(through->counts().broken > 50);
      if (choice.dimension == 3)
        CHECK(through->counts().contacts > 0);
      CHECK_FALSE(end == middle);

      for (const int threads : {1, 2, 4})
        {
          omp_set_num_threads(threads);
          const auto again = make(choice);
          first_part(*again);
          MemoryState again_middle = state_of(*again);
          check_same(middle, again_middle);

          const auto          resumed = make(choice);
          MemoryState::Reader reader(middle);
          resumed->visit_state(reader);
          second_part(*resumed);
          MemoryState resumed_end = state_of(*resumed);
          check_same(end, resumed_end);
          CHECK(resumed->grips().reaction(0) == through->grips().reaction(0));
          CHECK(resumed->energy().residual() == through->energy().residual());
          CHECK(resumed->mean_damage() == through->mean_damage());
          CHECK(resumed->particles().stress[7] == through->particles().stress[7]);
          CHECK(resumed->particles().displacement[7] == through->particles().displacement[7]);
          CHECK(resumed->counts().neighbour_searches == through->counts().neighbour_searches);
        }
      omp_set_num_threads(1);
    }
}

TEST_CASE("uniaxial test resumed past the peak draws the same curve (S13)", "[stability]")
{
  omp_set_num_threads(1);
  auto p    = cluster::bonded(1.5);
  p.damping = 0.3;
  dem::UniaxialParameters loading;
  loading.strain_rate        = 4;
  loading.grips.thickness    = 0.5e-3;
  loading.stop_strain        = 5e-3;
  const dem::Packing packing = cluster::cubic_lattice(4, 4, 6, 1e-3);
  const auto         drive   = [](dem::UniaxialTest &test, const int samples) {
    for (int n = 0; n < samples; ++n)
      test.advance(20);
  };
  dem::Specimen     body(packing, p, cluster::concrete());
  dem::UniaxialTest test(body, loading);
  drive(test, 120);
  MemoryState         memory;
  MemoryState::Writer writer(memory);
  body.visit_state(writer);
  test.visit_state(writer);
  drive(test, 60);

  dem::Specimen       other_body(packing, p, cluster::concrete());
  dem::UniaxialTest   other(other_body, loading);
  MemoryState::Reader reader(memory);
  other_body.visit_state(reader);
  other.visit_state(reader);
  drive(other, 60);
  REQUIRE(test.curve().size() == 180);
  REQUIRE(other.curve().size() == 180);
  for (std::size_t i = 0; i < 180; ++i)
    CHECK((test.curve()[i].strain == other.curve()[i].strain && test.curve()[i].stress == other.curve()[i].stress));
  CHECK(test.figures().strength == other.figures().strength);
  CHECK(body.mean_damage() > 0.1);
}
