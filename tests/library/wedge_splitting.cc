// Figures of wedge splitting, from the series of a run.
#include "apps/runs/structure/wedge_splitting.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  /** A cube of 100 mm with a ligament of 50 mm, split by a wedge of 30 degrees, 20 mm above the tip of its notch. */
  apps::WedgeSplittingSection cube()
  {
    apps::WedgeSplittingSection test;
    test.ligament_depth = 0.05;
    test.width          = 0.1;
    test.arm            = 0.02;
    return test;
  }
} // namespace

TEST_CASE("The load of a wedge is the stress of its ligament and the force of its machine, its work the ligament's",
          "[apps][structure]")
{
  postprocess::CsvTable series;
  series.names                            = {"load_factor",   "reaction_load_x", "energy_work",  "energy_stored",
                                             "energy_damage", "energy_friction", "energy_damped"};
  series.columns                          = {{0, 1e-4, 4e-4}, {0, 3000, 300}, {0, 0.15, 0.6}, {0, 0.15, 0.2},
                                             {0, 0, 0.35},    {0, 0, 0.03},   {0, 0, 0.02}};
  const apps::WedgeSplittingSection test  = cube();
  const nlohmann::json              found = test.figures(series, "reaction_load_x");
  const auto                        value = [&found](const char *name) { return found[name]["value"].get<double>(); };
  CHECK(value("splitting_force") == 3000);
  // Of the ligament b h: N / A + M / W, M = F (c + h/2), W = b h^2 / 6.
  CHECK(value("nominal_strength") == Approx(3000 / (0.1 * 0.05) + 3000 * (0.02 + 0.025) / (0.1 * 0.05 * 0.05 / 6)));
  CHECK(value("machine_force") == Approx(2 * 3000 * std::tan(M_PI / 12)));
  CHECK(value("work_of_fracture") == Approx(0.6 / (0.1 * 0.05)));
  CHECK(value("dissipated_over_ligament") == Approx(0.4 / (0.1 * 0.05)));
  CHECK(value("load_left") == Approx(0.1));
}

TEST_CASE("A rough wedge takes more force, and one that holds itself is refused", "[apps][structure]")
{
  apps::WedgeSplittingSection test = cube();
  // On a slope of 15 degrees with the angle of friction f, both sides together: 2 F tan(15 + f).
  test.friction = std::tan(10 * M_PI / 180);
  CHECK(test.machine_force(1) == Approx(2 * std::tan(25 * M_PI / 180)));
  CHECK_NOTHROW(test.check({}));
  test.friction = 4;
  CHECK_THROWS_WITH(test.check({}), Catch::Contains("Friction coefficient") && Catch::Contains("never moves"));
  test.ligament_depth = 0; // not evaluated
  CHECK_NOTHROW(test.check({}));
}
