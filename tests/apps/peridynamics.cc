// Scenes of kind "peridynamics": what they find, refuse and remember.
#include "apps/drivers/read_scene.h"
#include "apps/results/run_result.h"
#include "tests/apps/scene_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string shipped(const std::string &name)
  {
    return places::sources() + "/apps/scenes/peridynamic_" + name + ".prm";
  }

  apps::RunResult run_of(const apps::CheckedScene &scene, const std::filesystem::path &folder)
  {
    apps::RunRequest request = apps::request_of(scene);
    request.output_folder    = folder;
    return scene.scene->run(request);
  }

  apps::RunResult run_of(const ScratchFolder &folder, const std::string &name, const std::vector<std::string> &changes)
  {
    std::vector<std::string> all = changes;
    all.emplace_back("Output/Snapshots=0");
    return run_of(apps::read_scene(shipped(name), all), folder / "results");
  }

  /** It is stopped half way, goes on, and is compared with one that was not: rows, nodes and figures. */
  void goes_on(const std::string &name, const std::vector<std::string> &changes, const int asked_before)
  {
    const ScratchFolder      folder;
    std::vector<std::string> all = changes;
    all.emplace_back("Output/Snapshots=0");
    const apps::CheckedScene scene   = apps::read_scene(shipped(name), all);
    const apps::RunResult    whole   = run_of(scene, folder / "whole");
    apps::RunRequest         request = apps::request_of(scene);
    request.output_folder            = folder / "parts";
    int asked                        = 0;
    request.stop                     = [&] { return ++asked > asked_before; };
    REQUIRE(scene.scene->run(request).end == apps::RunResult::End::interrupted);
    request.stop                = nullptr;
    request.resume              = true;
    const apps::RunResult parts = scene.scene->run(request);
    CHECK(parts.series.columns == whole.series.columns);
    CHECK(content_of(folder / "parts/nodes.csv") == content_of(folder / "whole/nodes.csv"));
    CHECK(parts.summary["figures"] == whole.summary["figures"]);
  }

  /** Largest errors of u_x on y = 0 and of u_y on x = 0 of the pulled plate [%], from the table of nodes. */
  std::pair<double, double> errors_of_tension(const std::filesystem::path &table)
  {
    const postprocess::CsvTable nodes = postprocess::read_csv_table(table);
    CHECK(nodes.names == std::vector<std::string>{"x", "y", "z", "u_x", "u_y", "u_z", "damage", "volume"});
    CHECK(nodes.units == std::vector<std::string>{"m", "m", "m", "m", "m", "m", "-", "m^3"});
    double x_error = 0, y_error = 0;
    for (std::size_t n = 0; n < nodes.rows(); ++n)
      {
        const double x = nodes.column("x")[n], y = nodes.column("y")[n];
        if (std::abs(y) < 0.0051)
          x_error = std::max(x_error, std::abs(nodes.column("u_x")[n] + 1e-3 / 3 * x));
        if (std::abs(x) < 0.0051)
          y_error = std::max(y_error, std::abs(nodes.column("u_y")[n] - 1e-3 * y));
      }
    return {100 * x_error / (1e-3 / 3 * 0.495), 100 * y_error / (1e-3 * 0.245)};
  }
} // namespace

TEST_CASE("A plate that a scene pulls has the published errors, calibrated and not, at rest by either method", "[apps]")
{
  const ScratchFolder folder;
  const auto          check = [&](const std::vector<std::string> &changes, const double across, const double along) {
    const apps::RunResult result = run_of(folder, "tension", changes);
    const auto [x, y]            = errors_of_tension(folder / "results/nodes.csv");
    CHECK(x == Approx(across).margin(0.2).epsilon(0));
    CHECK(y == Approx(along).margin(0.2).epsilon(0));
    return result;
  };
  check({}, 3.4, 0.8);
  const apps::RunResult raw = check({"Material/Calibration=none"}, 7.7, 5.4);
  CHECK(raw.figure("lattice/young_modulus").value.value() == Approx(1.0486 * 200e9).epsilon(5e-5));
  CHECK(raw.figure("lattice/poisson_ratio").value.value() == Approx(0.3182).margin(5e-5));
  check({"Material/Calibration=none", "Analysis/Method=relaxation", "Analysis/Kinematics=nonlinear"}, 7.7, 5.4);
}

TEST_CASE("The rod of a scene has the displacement of the continuum", "[apps]")
{
  const ScratchFolder   folder;
  const apps::RunResult result = run_of(folder, "bar", {});
  CHECK(result.figure("largest_displacement").value.value() == Approx(1e-3 * 0.495).epsilon(1e-10));
}

TEST_CASE("The first bond of a scene's plate with a hole breaks at 377.5 MPa, whether the load comes to it or not",
          "[apps]")
{
  const ScratchFolder   folder;
  const apps::RunResult below = run_of(folder, "hole", {"Material/Critical stretch=0.0058"});
  CHECK(below.figure("first_break").value.value() == Approx(377.5e6).margin(0.2e6).epsilon(0));
  CHECK(below.summary["figures"]["broken_bonds"] == 0);
}

TEST_CASE("The plate with a hole holds at 376 MPa and breaks through at 380 MPa", "[apps][slow]")
{
  const ScratchFolder   folder;
  const apps::RunResult holds =
    run_of(folder, "hole",
           {"Material/Critical stretch=0.0058", "Tractions/below/Value=0, -376e6", "Tractions/above/Value=0, 376e6"});
  CHECK(holds.summary["figures"]["broken_bonds"] == 0);
  const apps::RunResult breaks = run_of(folder, "fracture", {});
  CHECK(breaks.figure("broken_through").value.value() == Approx(380e6).epsilon(1e-12));
  CHECK(breaks.figure("first_break").value.value() == Approx(377.5e6).margin(0.2e6).epsilon(0));
}

TEST_CASE("Peridynamic scenes that cannot be are refused by name", "[apps]")
{
  const ScratchFolder folder;
  const std::string   scene   = shipped("tension");
  const auto          refused = [&](const std::vector<std::string> &changes, const std::string &words) {
    is_refused(folder, scene, changes, words, {"check"});
  };
  refused({"Grid/Spacing=0.03"}, "must divide every length");
  refused({"Horizon/Ratio=0.9"}, "Ratio");
  refused({"Material/Poisson ratio=0.2"}, "0.333333");
  refused({"Body/Size=1, 0.5, 2, 3"}, "one to three lengths");
  refused({"Tractions/above/Value=0, 100e6"}, "do not balance");
  refused({"Tractions/above/Boundary=front"}, "left, right, bottom, top");
  refused({"Tractions/above/Value=0, 100e6, 3"}, "component along z");
  refused({"Tractions/above/Value=0, 100e6 +"}, "formulas");
  refused({"Analysis/Method=motion", "Analysis/End time=1e-4"}, "Density");
  refused({"Material/Critical stretch=0.01", "Material/Fracture energy=100"}, "leave one of them out");
  is_refused(folder, shipped("hole"), {"Holes/hole/Radius=0.4"}, "Holes", {"check"});
}

TEST_CASE("A peridynamic run that was stopped goes on to the same bits, fracture included", "[apps]")
{
  const std::vector<std::string> coarse = {"Grid/Spacing=0.001", "Analysis/End time=3e-5"};
  goes_on("branching", coarse, 40);
  goes_on("bending", {"Grid/Spacing=0.02"}, 3);
  goes_on("fracture", {"Grid/Spacing=0.0125", "Analysis/Load increments=4", "Material/Critical stretch=0.004"}, 3);
}

TEST_CASE("What check says of a peridynamic motion is what its run takes", "[apps]")
{
  const ScratchFolder      folder;
  const apps::CheckedScene scene =
    apps::read_scene(shipped("branching"), {"Grid/Spacing=0.001", "Analysis/End time=2e-5", "Output/Snapshots=0"});
  const std::string     said  = scene.scene->forecast();
  const apps::RunResult found = run_of(scene, folder / "results");
  CHECK_THAT(said, Contains("steps        ") && Contains("nodes        4000"));
  const double steps = std::stod(said.substr(said.find("steps        ") + 13));
  CHECK(found.summary["figures"]["steps"].get<double>() == Approx(steps).margin(1.01));
  CHECK(found.figure("energy_balance_error").value.value() < 1e-3);
}
