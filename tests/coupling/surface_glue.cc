// Particles that are glued to a deformable solid: momentum and energy of the surface coupling.
#include "block_fixture.h"
#include "dem/facets/surface.h"

#include <catch2/catch.hpp>

using namespace block;

namespace
{
  /** A mast of three bonded balls, glued to a free block, whose top is knocked. */
  struct Mast
  {
    Block<3>                      block;
    dem::Specimen                 specimen;
    coupling::ConcurrentMotion<3> both;

    explicit Mast(const double step_factor = 0.2)
      : block(3)
      , specimen(balls(), how(step_factor), mortar())
      , both(specimen, block.solid, *block.motion, *block.participant)
    {
      specimen.set_velocity(2, {1, -0.6, 0.2}, {0, 20, 40});
      coupling::SurfaceCouplingParameters glued{"foot", {"5"}, rough()};
      glued.glue.within = 1e-6;
      both.add_surface(glued);
    }
    static dem::Packing balls()
    {
      dem::Packing packing;
      packing.centre = {{0.041, 0.057, 0.11}, {0.041, 0.057, 0.13}, {0.041, 0.057, 0.15}};
      packing.radius.assign(3, 0.01);
      return packing;
    }
    static dem::SpecimenParameters how(const double step_factor)
    {
      auto p        = cluster::bonded(1.05);
      p.step_factor = step_factor;
      p.damping     = 0;
      return p;
    }
    static dem::ParallelBondParameters mortar()
    {
      dem::ParallelBondParameters p;
      p.effective_modulus = 1e8;
      p.tensile_strength = p.cohesion = 1e12;
      return p;
    }
    /** Central differences keep the sums of m v(n-1/2), and of x(n) x m v(n-1/2) + I w. */
    std::pair<Vector3d, Vector3d> momenta() const
    {
      Vector3d linear = block.momentum(), angular = Vector3d::Zero();
      for (std::size_t i = 0; i < block.participant->carriers(); ++i)
        angular += block.participant->position(i).cross(block.participant->mass(i) * block.participant->velocity(i));
      for (std::size_t i = 0; i < 3; ++i)
        {
          const dem::ParticleState p = specimen.particle(i);
          linear += p.mass * p.velocity;
          angular += p.position.cross(p.mass * p.velocity) + p.inertia * p.spin;
        }
      return {linear, angular};
    }
    double energy() const
    {
      const auto e = specimen.energy();
      const auto s = block.motion->energy();
      return e.kinetic + e.elastic + s.kinetic + s.internal;
    }
  };
} // namespace

TEST_CASE("surface coupling: glue keeps momentum, angular momentum and energy of a closed system, couples included",
          "[coupling]")
{
  Mast         mast;
  const double step  = 0.5 * std::min(mast.both.solid_step(), mast.both.particle_step());
  const auto   start = mast.momenta();

  mast.both.advance(step);
  const double energy = mast.energy();
  double       linear = 0, angular = 0;
  for (int n = 0; n < 1500; ++n)
    {
      mast.both.advance(step);
      const auto now = mast.momenta();
      linear         = std::max(linear, (now.first - start.first).norm());
      angular        = std::max(angular, (now.second - start.second).norm());
    }
  CHECK(linear < 1e-12 * start.first.norm());
  CHECK(angular < 1e-10 * start.second.norm());
  CHECK(mast.energy() == Approx(energy).epsilon(1e-3));
  const coupling::SurfaceBalance b = mast.both.surfaces().front()->balance();
  CHECK(b.to_solid.norm() > 0.1 * start.first.norm());
  CHECK((b.to_particles + b.to_solid).norm() < 1e-12 * b.to_solid.norm());
  CHECK((b.turn_to_particles + b.turn_to_solid).norm() < 1e-10 * b.turn_to_solid.norm());
  CHECK(std::fabs(b.spurious()) < 1e-12 * (std::fabs(b.work_on_solid) + energy));
  CHECK(mast.specimen.energy().balance_error() < 1e-3);
}

TEST_CASE("surface coupling: glue keeps momentum and angular momentum with particles sub-cycled", "[coupling]")
{
  Mast mast(0.02);
  mast.both.set_largest_ratio(4);
  const auto            start = mast.momenta();
  coupling::WindowSteps steps;
  double                energy = 0;
  for (int n = 0; n < 1500; ++n)
    {
      steps = mast.both.advance(1);
      if (n == 0)
        energy = mast.energy();
    }
  CHECK(steps.particles > 1);
  const auto now = mast.momenta();
  CHECK((now.first - start.first).norm() < 1e-12 * start.first.norm());
  CHECK((now.second - start.second).norm() < 1e-10 * start.second.norm());
  CHECK(mast.energy() < 1.001 * energy);
}

TEST_CASE("surface coupling: glue keeps momentum and angular momentum with the solid sub-cycled", "[coupling]")
{
  Mast mast(0.8);
  mast.both.set_largest_ratio(8);
  const auto            start = mast.momenta();
  coupling::WindowSteps steps;
  double                energy = 0, most = 0;
  for (int n = 0; n < 1500; ++n)
    {
      steps = mast.both.advance(1);
      if (n == 0)
        energy = mast.energy();
      most = std::max(most, mast.energy());
    }
  CHECK(steps.solid > 1);
  const auto now = mast.momenta();
  CHECK((now.first - start.first).norm() < 1e-12 * start.first.norm());
  CHECK((now.second - start.second).norm() < 1e-10 * start.second.norm());
  CHECK(most < 1.001 * energy);
  CHECK(mast.specimen.energy().balance_error() < 5e-3);
}
