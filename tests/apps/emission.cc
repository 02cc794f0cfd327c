// Acoustic emission of scenes: figures, files, the same run with and without.
#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  double sum(const std::vector<double> &values) { return std::accumulate(values.begin(), values.end(), 0.0); }

  std::size_t rows_of(const std::string &csv)
  {
    return static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) - 1;
  }
} // namespace

TEST_CASE("scene that is listened to has its events as figures and files, and is the same run otherwise",
          "[apps][emission]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("scene.prm", scene_with_file());
  for (const std::string reach : {"0", "2"})
    {
      const Outcome outcome =
        run(folder.path(), {"run", "scene.prm", "-s", "Emission/Reach=" + reach, "-o", "reach_" + reach});
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      CHECK((outcome.out.find("\nemission     ") != std::string::npos) == (reach == "2"));
    }
  CHECK(content_of(folder / "reach_0/series.csv") == content_of(folder / "reach_2/series.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "reach_0/tension_events.csv"));
  const auto summary = nlohmann::json::parse(content_of(folder / "reach_2/summary.json"));
  for (const std::string test : {"tension", "compression"})
    {
      INFO(test);
      const std::string csv   = content_of(folder / "reach_2" / (test + "_events.csv"));
      const auto        table = postprocess::read_csv_table(folder / "reach_2" / (test + "_events.csv"), true);
      const auto       &found = summary["figures"];
      CHECK(found[test + "_emission_events"]["value"] == rows_of(csv));
      double broken = 0;
      for (const auto &details : summary["tests"])
        if (details["name"] == test)
          broken = details["broken_links"];
      CHECK(sum(table.column("gradual")) == broken);
      CHECK(std::filesystem::exists(folder / "reach_2" / (test + "_emission.vtp")));
      const auto &b = found[test + "_emission_b_value"];
      if (b["value"].is_null())
        CHECK_THAT(b["not_determined"].get<std::string>(), Contains("10 events"));
      else
        CHECK(b["standard_error"] > 0);
    }
  const Outcome refused = run(folder.path(), {"check", "scene.prm", "-s", "Emission/Reach=-1"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("Emission") && Contains("Reach"));
}
