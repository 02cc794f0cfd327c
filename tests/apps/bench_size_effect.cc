// Laws of size effect, and the bench that fits them to beams of one shape.
#include "apps/bench/size_effect_laws.h"
#include "base/errors.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace apps_tests;
using Catch::Contains;
using Catch::WithinAbs;
using Catch::WithinRel;

namespace
{
  /** Beams of 20 to 160 mm that follow a law, three of each with a scatter of 3 %. */
  std::vector<apps::SizeStrength> beams_of(const apps::SizeEffectLaw &law, const double scatter)
  {
    std::vector<apps::SizeStrength> beams;
    for (const double depth : {0.02, 0.04, 0.08, 0.16})
      for (const double part : {-1.0, 0.0, 1.0})
        beams.push_back({depth, law.at(depth) * std::exp(scatter * part)});
    return beams;
  }

  apps::SizeEffectLaw law_of(const double strength, const double depth, const double exponent)
  {
    apps::SizeEffectLaw law;
    law.strength.value = strength;
    law.depth.value    = depth;
    law.exponent.value = exponent;
    return law;
  }
} // namespace

TEST_CASE("laws of size effect are found again from beams that follow them, within their own uncertainty",
          "[apps][mesoscale]")
{
  const apps::SizeEffectLaw exact = apps::fitted_bazant(beams_of(law_of(5e6, 0.05, 1), 0));
  CHECK_THAT(exact.strength.value, WithinRel(5e6, 1e-6));
  CHECK_THAT(exact.depth.value, WithinRel(0.05, 1e-5));
  CHECK(exact.scatter < 1e-6);

  const apps::SizeEffectLaw free = apps::fitted_with_exponent(beams_of(law_of(5e6, 0.05, 0.6), 0));
  CHECK_THAT(free.exponent.value, WithinRel(0.6, 1e-3));
  CHECK_THAT(free.strength.value, WithinRel(5e6, 1e-3));

  const apps::SizeEffectLaw rough = apps::fitted_bazant(beams_of(law_of(5e6, 0.05, 1), 0.03));
  CHECK(std::fabs(rough.strength.value - 5e6) < rough.strength.half_width);
  CHECK(std::fabs(rough.depth.value - 0.05) < rough.depth.half_width);
  CHECK_THAT(rough.scatter,
             WithinRel(0.03 * std::sqrt(8.0 / 10), 1e-3)); // eight of twelve are off by 3 %, two constants

  // Small beams fail by strength, large ones as a crack does: with the root of the size.
  CHECK_THAT(law_of(5e6, 0.05, 1).at(1e-9), WithinRel(5e6, 1e-6));
  CHECK_THAT(law_of(5e6, 0.05, 1).at(50) * std::sqrt(50.0), WithinRel(5e6 * std::sqrt(0.05), 1e-3));
}

TEST_CASE("strengths that do not fall with the size have no law of size effect", "[apps][mesoscale]")
{
  CHECK_THROWS_WITH(apps::fitted_bazant({{0.02, 3e6}, {0.04, 3.1e6}, {0.08, 3.2e6}}), Contains("does not fall"));
  CHECK_THROWS_WITH(apps::fitted_bazant({{0.02, 3e6}, {0.02, 3.1e6}, {0.02, 2.9e6}}), Contains("two sizes"));
  CHECK_THROWS_AS(apps::fitted_bazant({{0.02, 3e6}, {0.04, 2e6}}), base::InputError);
}

TEST_CASE("the crack of a beam has the published shape, and its law gives back the energy that it was made of",
          "[apps][mesoscale]")
{
  // RILEM TC 89-FMT (1990), span of 2.5 depths: F(0.3) of the polynomial, by hand.
  const double F = (1 - 0.75 + 0.4041 - 0.10746 + 0.010773) / std::pow(0.7, 1.5);
  CHECK_THAT(apps::shape_of_crack(0.3), WithinRel(M_PI * 0.3 * F * F, 1e-12));
  // Bazant, Pfeiffer (1987), ACI Mater. J. 84, 463: g = 6.07 for a notch of a sixth, of the nominal stress P/(bD) = sigma_N/3.75.
  CHECK_THAT(3.75 * 3.75 * apps::shape_of_crack(1.0 / 6), WithinAbs(6.07, 0.01));

  const double              young = 30e9, alpha = 0.3;
  const apps::SizeEffectLaw law   = law_of(4e6, 0.06, 1);
  const apps::CrackOfLaw    crack = apps::crack_of(law, alpha, young);
  // A very large beam fails at K = sqrt(E G).
  CHECK_THAT(std::pow(law.at(1e6), 2) * 1e6 * apps::shape_of_crack(alpha) / young, WithinRel(crack.energy, 1e-6));
  // One beam of that law and its energy give back the law.
  const apps::SizeEffectLaw from_one = apps::law_of_one_size({0.04, law.at(0.04)}, crack.energy, alpha, young);
  CHECK_THAT(from_one.strength.value, WithinRel(4e6, 1e-6));
  CHECK_THAT(from_one.depth.value, WithinRel(0.06, 1e-6));
  CHECK_THROWS_WITH(apps::law_of_one_size({0.04, 2 * law.at(1e-6)}, crack.energy, alpha, young), Contains("no law"));
}

TEST_CASE("bench size-effect refuses a scene without a bending test, and a size that it does not run",
          "[apps][mesoscale]")
{
  const ScratchFolder folder;
  const std::string   scenes = places::sources() + "/apps/scenes/";
  const Outcome other = run(folder.path(), {"bench", "size-effect", scenes + "wedge_splitting.prm", "-o", "bench"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("Bending test"));
  const Outcome size =
    run(folder.path(), {"bench", "size-effect", scenes + "size_effect.prm", "--sizes", "1,4", "-o", "bench"});
  CHECK(size.status == 2);
  CHECK_THAT(size.err, Contains("--calibrated"));
}
