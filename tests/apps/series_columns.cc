// Columns of a series: which are drawn, which end a run, what a summary reports of them.
#include "apps/figures/drawn_curve.h"
#include "apps/runs/continuum/summary.h"
#include "apps/runs/particles/stops.h"
#include "apps/scene/overrides.h"
#include "apps/scene/particles/model.h"
#include "apps/scene/particles/stops.h"
#include "apps/scene/reader.h"
#include "apps/scene/section.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  const std::vector<std::string> names = {"time", "reaction_left_x", "largest_damage"};

  postprocess::CsvTable table(const std::vector<std::string>         &columns,
                              const std::vector<std::string>         &units,
                              const std::vector<std::vector<double>> &values)
  {
    postprocess::CsvTable made;
    made.names   = columns;
    made.units   = units;
    made.columns = values;
    return made;
  }

  apps::StopsSection stops(const std::vector<std::string> &texts)
  {
    apps::Section      root;
    apps::StopsSection read;
    declare(root, read);
    assign(root, apps::read_overrides(texts), "test");
    with_places(root, [&] { read.check({}, names); });
    return read;
  }
} // namespace

TEST_CASE("The requested column is drawn, else the program's choice; a wrong one is refused", "[apps]")
{
  CHECK(apps::chosen_column(names, "Curve vertical", "", "time") == "time");
  CHECK(apps::chosen_column(names, "Curve vertical", "largest_damage", "time") == "largest_damage");
  CHECK_THROWS_WITH(apps::chosen_column(names, "Curve vertical", "largest_damge", "time"),
                    Contains("Output/Curve vertical = largest_damge: series.csv has no such column. Did you mean "
                             "\"largest_damage\"?"));
}

TEST_CASE("A curve is drawn upwards, its peak is the row of the largest magnitude", "[apps]")
{
  CHECK(apps::peak_row({1, -5, 4}) == 1);
  CHECK(apps::peak_row({0}) == 0);
  const auto series = table({"strain", "force"}, {"-", "N"}, {{0, 1e-3, 2e-3}, {0, -3e3, -1e3}});
  const auto panel  = apps::drawn_curve(series, "strain", "force", "crushed");
  REQUIRE(panel.series.size() == 1);
  CHECK(panel.title == "crushed");
  const auto &y = panel.series[0].y;
  CHECK(y[1] > 0);
  CHECK(y[1] == Approx(3 * y[2]));
  CHECK_THAT(panel.y_label, Catch::StartsWith("- "));
  CHECK(panel.series[0].x[1] > 0);
}

TEST_CASE("A condition of Stop ends a run beyond its value, and not before its time", "[apps]")
{
  const auto cracked = stops({"Stop/cracked/Column=largest_damage", "Stop/cracked/Value=0.9"});
  CHECK(cracked.fulfilled(names, {1, 0, 0.9}).empty());
  CHECK(cracked.fulfilled(names, {1, 0, 0.91}) == "cracked");
  const auto released = stops({"Stop/released/Column=reaction_left_x", "Stop/released/Value=-10",
                               "Stop/released/When=below", "Stop/released/From time=2"});
  CHECK(released.fulfilled(names, {1, -20, 0}).empty());
  CHECK(released.fulfilled(names, {2, -20, 0}) == "released");
  CHECK(released.fulfilled(names, {2, -10, 0}).empty());
  const auto both = stops({"Stop/a/Column=time", "Stop/a/Value=5", "Stop/b/Column=time", "Stop/b/Value=3"});
  CHECK(both.fulfilled(names, {6, 0, 0}) == "a"); // the first in the scene
  CHECK(both.fulfilled(names, {4, 0, 0}) == "b");
  CHECK_THROWS_WITH(stops({"Stop/a/Column=tiem", "Stop/a/Value=1"}),
                    Contains("Stop/a/Column = tiem: series.csv has no such column. Did you mean \"time\"?"));
}

TEST_CASE("The summary of a solid holds its probes as they are declared", "[apps]")
{
  using apps::ProbeColumn;
  using Reported = ProbeColumn::Reported;
  apps::RunRequest request;
  request.scene_file           = "bar.prm";
  postprocess::CsvTable series = table({"load_factor", "opening", "reaction_left_x", "energy_dissipated",
                                        "energy_stored", "energy_residual", "energy_balance_error", "wetness"},
                                       {"-", "m", "N", "J", "J", "J", "-", "kg"},
                                       {{1, 2, 3},
                                        {0.1, 0.2, 0.3},
                                        {5, -8, 2},
                                        {0, 1, 4},
                                        {10, 9, 9},
                                        {0, -2e-8, 1e-8},
                                        {0, 1, 2}, // over energies near zero it says nothing
                                        {3, 2, 1}});
  apps::ContinuumReport report{request,
                               series,
                               {{{"reaction_left_x", "N"}, Reported::peak},
                                {{"energy_stored", "J"}, Reported::not_at_all},
                                {{"energy_dissipated", "J"}, Reported::last, "dissipated_energy"},
                                {{"wetness", "kg"}, Reported::last, "wetness"}}};
  report.cost        = {{"steps", 3}};
  report.is_static   = true;
  report.ended_by    = "end";
  const auto summary = report.summary();
  const auto figures = summary["figures"];
  CHECK(figures["peak_reaction_left_x"] ==
        nlohmann::json({{"value", -8.0}, {"unit", "N"}, {"at_load_factor", 2.0}, {"at_opening", 0.2}}));
  CHECK(figures["peak_load_factor"]["value"] == 3);
  CHECK(figures["final_opening"] == nlohmann::json({{"value", 0.3}, {"unit", "m"}}));
  CHECK(figures["dissipated_energy"] == nlohmann::json({{"value", 4.0}, {"unit", "J"}}));
  CHECK(figures["wetness"] == nlohmann::json({{"value", 1.0}, {"unit", "kg"}}));
  CHECK(figures.size() == 5);
  CHECK(summary["energy"]["balance_error"].get<double>() ==
        Approx(2e-9)); // the largest of all rows over the largest energy
  CHECK(summary["energy"]["residual"] == 1e-8);
  CHECK(summary["warnings"].empty());
  CHECK(summary["energy"]["stored"] == 9);
  CHECK_THAT(report.text(), Contains("wetness") && Contains("kg") && !Contains("warning"));

  series.columns[5][1] = 0.6;
  CHECK_THAT(
    report.text(),
    Contains("warning      the energies do not balance by 6 % of the largest: the steps are too "
             "long for the work that they count. Shorten Control/Largest step") &&
      Contains("where the load falls at once (snap-back) no step is short enough: set Control/Follow = indirect"));
  series.columns[5][1] = 0.4;
  CHECK_THAT(report.text(), !Contains("warning"));
}
