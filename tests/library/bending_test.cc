// Figures of a notched beam in bending, from its series.
#include "apps/runs/structure/bending_test.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace
{
  /** A beam of 100 mm x 50 mm x 40 mm span, width, depth, notched by 10 mm. */
  apps::BendingTestSection beam()
  {
    apps::BendingTestSection test;
    test.span  = 0.1;
    test.width = 0.05;
    test.depth = 0.04;
    test.notch = 0.01;
    return test;
  }
} // namespace

TEST_CASE("The load of a beam is the bending stress of its ligament, and its work the ligament's work of fracture",
          "[apps][structure]")
{
  // A line up to 2000 N at 0.1 mm and another one down to 500 N at 0.4 mm: 0.1 J + 0.375 J. A third of it is still stored.
  postprocess::CsvTable series;
  series.names      = {"load_factor",   "reaction_load_z", "energy_work",  "energy_stored",
                       "energy_damage", "energy_friction", "energy_damped"};
  series.columns    = {{0, 1e-4, 4e-4}, {0, -2000, -500}, {0, 0.1, 0.475}, {0, 0.1, 0.175},
                       {0, 0, 0.25},    {0, 0, 0.03},     {0, 0, 0.02}};
  const auto figure = [&series](const apps::BendingTestSection &test, const double weight) {
    return [found = test.figures(series, "reaction_load_z", weight)](const char *name) {
      return found[name]["value"].get<double>();
    };
  };
  const auto value = figure(beam(), 0);
  CHECK(value("nominal_strength") ==
        Approx(1.5 * 2000 * 0.1 / (0.05 * 0.03 * 0.03))); // M / W, M = F L / 4, W = b h^2 / 6
  CHECK(value("nominal_strength") == Approx((2000 * 0.1 / 4) / (0.05 * 0.03 * 0.03 / 6)));
  CHECK(value("work_of_fracture") == Approx(0.475 / (0.05 * 0.03)));
  CHECK(value("dissipated_over_ligament") == Approx(0.3 / (0.05 * 0.03)));
  CHECK(value("load_left") == Approx(0.25));

  // RILEM TC 50-FMC (1985): of 30 N over 120 mm 25 are between the supports, and went down by 0.4 mm. What the weight itself did is its own.
  apps::BendingTestSection heavy = beam();
  heavy.length                   = 0.12;
  series.names.insert(series.names.end(), {"energy_weight", "force_of_load_factor"});
  series.columns.insert(series.columns.end(), {{0, 0.003, 0.012}, {0, 2000, 500}});
  series.columns[2]      = {0, 0.103, 0.487};
  const auto with_weight = figure(heavy, 30);
  CHECK(with_weight("work_of_load") == Approx(0.475 / (0.05 * 0.03)));
  CHECK(with_weight("deflection") == Approx(4e-4));
  CHECK(with_weight("work_of_fracture") == Approx((0.475 + 25 * 4e-4) / (0.05 * 0.03)));
}

TEST_CASE("A notch through the whole beam is refused", "[apps][structure]")
{
  apps::BendingTestSection test = beam();
  CHECK_NOTHROW(test.check({}, false));
  CHECK_THROWS_WITH(test.check({}, true), Catch::Contains("Length") && Catch::Contains("must not be below Span"));
  test.notch = test.depth;
  CHECK_THROWS_WITH(test.check({}, false), Catch::Contains("Notch depth") && Catch::Contains("must be below Depth"));
  test.span = 0; // not evaluated
  CHECK_NOTHROW(test.check({}, false));
}
