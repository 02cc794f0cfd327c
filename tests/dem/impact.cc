#include "dem/loading/impact.h"

#include "base/errors.h"
#include "dem/laws/cpm.h"
#include "dem/packing/lattice.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  constexpr double r = 2e-3;

  /** A beam of touching spheres in a simple cubic lattice, 20 x 4 x 4. */
  dem::Packing beam()
  {
    dem::Packing packing;
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k)
          {
            packing.centre.emplace_back((2 * i + 1) * r, (2 * j + 1) * r, (2 * k + 1) * r);
            packing.radius.push_back(r);
          }
    return packing;
  }

  dem::SpecimenParameters specimen_of()
  {
    dem::SpecimenParameters p;
    p.density           = 2400;
    p.interaction_ratio = 1.5;
    p.damping           = 0;
    p.loose             = 1;
    return p;
  }

  dem::CpmParameters concrete(const double limit_strain)
  {
    dem::CpmParameters law;
    law.normal_modulus       = 30e9;
    law.shear_ratio          = 0.2;
    law.limit_elastic_strain = limit_strain;
    law.relative_ductility   = 30;
    law.cohesion             = limit_strain * 30e9;
    law.friction_coefficient = 0.8;
    return law;
  }

  dem::ImpactParameters blow(const double velocity)
  {
    dem::ImpactParameters p;
    p.span             = 0.06;
    p.support_width    = 3 * r;
    p.impactor_radius   = 5e-3;
    p.impactor_velocity = velocity;
    p.longest          = 5e-3;
    return p;
  }
} // namespace

TEST_CASE("an impactor flies, hits, rebounds and leaves, and the energies balance", "[dem][loading]")
{
  const auto      parameters = blow(1.0);
  dem::Specimen   body(dem::with_impactor(beam(), parameters, 3), specimen_of(), concrete(1.0)); // elastic
  dem::ImpactTest test(body, parameters);
  const double    mass = 2400 * 4.0 / 3.0 * M_PI * std::pow(5e-3, 3);
  CHECK(test.impactor_energy() == Approx(0.5 * mass).epsilon(1e-12));
  CHECK(body.links().ends.size() == body.counts().links); // links of the beam alone: the impactor has none
  for (const auto &ends : body.links().ends)
    REQUIRE(ends[1] < 320);
  double lowest = 1;
  while (!test.finished())
    lowest = std::min(lowest, test.advance(200).impactor_velocity);
  CHECK(body.time() < parameters.longest); // it came to rest, the clock did not run out
  CHECK(lowest < -0.1);                    // rebound
  CHECK(test.absorbed() > 0);
  CHECK(test.absorbed() < test.impactor_energy());
  CHECK(body.energy().balance_error() < 1e-3);
  CHECK(body.mean_damage() == 0);
}

TEST_CASE("a harder blow leaves more damage", "[dem][loading]")
{
  double before = -1;
  for (const double velocity : {3.0, 8.0, 16.0})
    {
      const auto      parameters = blow(velocity);
      dem::Specimen   body(dem::with_impactor(beam(), parameters, 3), specimen_of(), concrete(1e-4));
      dem::ImpactTest test(body, parameters);
      while (!test.finished())
        test.advance(1000);
      CHECK(body.mean_damage() > before);
      CHECK(body.energy().balance_error() < 1e-2);
      before = body.mean_damage();
    }
  CHECK(before > 0);
}

TEST_CASE("impact parameters out of range are refused by name", "[dem][loading]")
{
  auto parameters = blow(0);
  CHECK_THROWS_WITH(dem::with_impactor(beam(), parameters, 3), Catch::Contains("Impact/Impactor velocity = 0"));
  parameters      = blow(1);
  parameters.span = 1;
  dem::Specimen body(dem::with_impactor(beam(), parameters, 3), specimen_of(), concrete(1e-4));
  CHECK_THROWS_WITH(dem::ImpactTest(body, parameters), Catch::Contains("a support would hold no particle"));
}
