#include "apps/specimens/static_start.h"
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Three spheres of 1 mm upon each other; the grips hold the first and the last. */
  const std::string row_of_three = "0 0 0 1e-3\n0 0 2e-3 1e-3\n0 0 4e-3 1e-3\n";

  /** The scene of a packing file with gravity of 1e5 m/s^2, one test, few steps. */
  std::vector<std::string> heavy(std::vector<std::string> arguments)
  {
    for (const char *entry :
         {"Gravity/Acceleration=0, 0, -1e5", "Loading/Tests=compression", "Loading/Compression/Stop strain=1e-4",
          "Loading/Compression/Strain rate=5", "Output/Samples=20"})
      {
        arguments.emplace_back("-s");
        arguments.emplace_back(entry);
      }
    return arguments;
  }
} // namespace

TEST_CASE("A scene with gravity starts from equilibrium, and says what it found", "[apps][gravity]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", row_of_three);
  folder.file("x.prm", replaced(scene_with_file(), "Interaction ratio = 1.5", "Interaction ratio = 1.2"));
  // The sphere in the middle hangs on one link and stands on the other: weight over twice the stiffness.
  const double radius = 1e-3, sag = 4800 * 4.0 / 3 * M_PI * std::pow(radius, 3) * 1e5 / (2 * 25e9 * M_PI * radius / 2);

  const Outcome checked = run(folder.path(), heavy({"check", "x.prm"}));
  CHECK(checked.status == 0);
  CHECK_THAT(checked.out, Contains("start        displaced by"));

  const Outcome outcome = run(folder.path(), heavy({"run", "x.prm", "-o", "results"}));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("start        displaced by"));
  const auto summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
  const auto found   = summary["tests"][0]["initial_equilibrium"];
  CHECK(found["largest_displacement"]["value"].get<double>() == Approx(sag).epsilon(1e-8));
  CHECK(found["largest_strain_over_limit"].get<double>() == Approx(sag / (2 * radius) / 1e-4).epsilon(1e-8));
  CHECK(found["damaged_links"] == 0);
  CHECK(found["unbalanced_ratio"].get<double>() < 1e-8);
  CHECK(summary["energy"]["gravity"].is_number());
  CHECK(summary["energy"]["balance_error"].get<double>() < 1e-6);
  CHECK_NOTHROW(postprocess::read_csv_table(folder / "results/series.csv", false, {"test"}).column("energy_gravity"));

  const Outcome sudden =
    run(folder.path(), heavy({"run", "x.prm", "-o", "sudden", "-s", "Gravity/Initial equilibrium=none"}));
  REQUIRE(sudden.status == 0);
  CHECK_FALSE(
    nlohmann::json::parse(content_of(folder / "sudden/summary.json"))["tests"][0].contains("initial_equilibrium"));
}

TEST_CASE("Gravity that nothing can carry is refused with the reason, and nothing is written", "[apps][gravity][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", scene_with_file());
  const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string> &words) {
    for (const char *command : {"check", "run"})
      {
        std::vector<std::string> whole = {command};
        whole.insert(whole.end(), arguments.begin(), arguments.end());
        if (whole[0] == "run")
          whole.insert(whole.end(), {"-o", "results"});
        const Outcome outcome = run(folder.path(), whole);
        CHECK(outcome.status == 2);
        for (const std::string &word : words)
          CHECK_THAT(outcome.err, Contains(word));
        CHECK_FALSE(std::filesystem::exists(folder / "results"));
      }
  };
  refused({"x.prm", "-s", "Gravity/Acceleration=1, 0, -9.81"}, {"Initial equilibrium", "no grip or support"});
  refused({"x.prm", "-s", "Gravity/Acceleration=0, 0, heavy"}, {"Gravity/Acceleration"});
  refused({"x.prm", "-s", "Gravity/Initial equilibrium=dynamic"}, {"none", "static"});
  refused({"x.prm", "-s", "Gravity/Acceleration=0, 0, -1e7"}, {"under gravity alone", "links", "particles"});
  refused({"x.prm", "-s", "Physics/Dimension=2", "-s", "Specimen/Thickness=1", "-s", "Loading/Axis=x", "-s",
           "Gravity/Acceleration=0, 0, -9.81"},
          {"Gravity", "z must be 0"});
}

TEST_CASE("A log says how far the search for an initial equilibrium is", "[apps][gravity]")
{
  dem::InitialEquilibrium so_far;
  CHECK(apps::search_text(so_far) == "solution 1");
  so_far.solutions        = 2;
  so_far.unbalanced_ratio = 2.53e-6;
  CHECK(apps::search_text(so_far) == "solution 3: unbalanced force 2.5e-06 of the link forces, sought 1e-10");
}
