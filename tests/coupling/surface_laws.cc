// Particles on a deformable solid by a law of contacts that is not linear.
#include "block_fixture.h"
#include "dem/laws/hertz_mindlin.h"

#include <catch2/catch.hpp>

using namespace block;

namespace
{
  /** A spinning ball on its way to a face of the free block. */
  struct LossyCollision
  {
    Block<3>                      block;
    dem::Specimen                 specimen;
    coupling::ConcurrentMotion<3> both;

    explicit LossyCollision(const double restitution)
      : block(3)
      , specimen(ball(0.02, {0.03, 0.04, 0.1205}, {2, -1, -5}, {40, 100, -60}, 0.1))
      , both(specimen, block.solid, *block.motion, *block.participant)
    {
      dem::HertzMindlinParameters law;
      law.young_modulus        = 5e8;
      law.poisson_ratio        = 0.2;
      law.friction_coefficient = 0.4;
      law.restitution          = restitution;
      both.add_surface({"block", {}, law});
    }
    double   step() const { return 0.5 * std::min(both.solid_step(), both.particle_step()); }
    Vector3d total_momentum() const { return momentum(specimen) + block.momentum(); }
    double   energy() const
    {
      const dem::EnergyAccount e = specimen.energy();
      const auto               s = block.motion->energy();
      return e.kinetic + e.elastic + e.friction + e.released + e.damping + s.kinetic + s.internal;
    }
  };
} // namespace

TEST_CASE("surface coupling: elastic spheres with a dashpot keep momentum and energy with a solid", "[coupling]")
{
  double lost[2];
  for (const int damped : {0, 1})
    {
      LossyCollision c(damped ? 0.5 : 1.0);
      c.both.advance(c.step());
      const Vector3d start  = c.total_momentum();
      const double   energy = c.energy();
      bool           met    = false;
      for (int n = 0; n < 100000 && !(met && c.specimen.surfaces().contacts().empty()); ++n)
        {
          c.both.advance(c.step());
          met = met || !c.specimen.surfaces().contacts().empty();
        }
      REQUIRE(met);
      for (int n = 0; n < 5; ++n)
        c.both.advance(c.step());
      CHECK((c.total_momentum() - start).norm() < 1e-12 * start.norm());
      CHECK(c.energy() == Approx(energy).epsilon(1e-3));
      CHECK(c.specimen.energy().balance_error() < 1e-3);
      lost[damped] = c.specimen.energy().damping;
    }
  CHECK(lost[0] == 0);
  CHECK(lost[1] > 0);
}
