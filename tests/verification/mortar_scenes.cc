// Grown and jointed mortar between platens against what is published for its constants, through the program.
#include "tests/verification/scene_results.h"

TEST_CASE("Mortar of four sizes with the published constants has the published strength and stiffness",
          "[verification][slow]")
{
  // Ortiz-Cahun et al. (2023): joints calibrated for 2.75 MPa and 7994 MPa on 150 mm x 300 mm; a window of it.
  const SceneResults found = results_of("mortar_window");
  const auto        &test  = found.summary["figures"]["laboratory"];
  CHECK(test["compressive_strength"]["value"].get<double>() == Approx(2.75e6).epsilon(0.15));
  CHECK(test["young_modulus"]["value"].get<double>() == Approx(7.994e9).epsilon(0.15));
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
}

TEST_CASE("Concrete with aggregates: a window has the published ratio of Poisson, is a quarter too stiff and too weak",
          "[verification][slow]")
{
  // Su et al. (2021), Table 3: 32.23 MPa, 28.37 GPa, 0.197 on 200 mm x 100 mm. What is not published (damping, what a bond's moment does
  // to its strength, the pressure it is bonded under) decides on strength and modulus: doc/tutorials/mortar.md.
  const SceneResults found = results_of("concrete_aggregates", {"Specimen/Genesis/Size=0.1, 0.05, 0"});
  const auto        &test  = found.summary["figures"]["laboratory"];
  CHECK(test["poisson_ratio"]["value"].get<double>() == Approx(0.197).margin(0.05));
  CHECK(test["compressive_strength"]["value"].get<double>() == Approx(0.72 * 32.23e6).epsilon(0.05));
  CHECK(test["young_modulus"]["value"].get<double>() == Approx(1.25 * 28.37e9).epsilon(0.05));
  CHECK(found.summary["energy"]["balance_error"].get<double>() < 1e-3);
}
