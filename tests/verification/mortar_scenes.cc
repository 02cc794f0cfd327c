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
