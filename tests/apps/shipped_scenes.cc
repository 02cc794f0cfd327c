#include "apps/scene/description.h"
#include "apps/scene/kinds/read_scene.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("Every scene that is shipped is valid and can be set up", "[apps][slow]")
{
  const ScratchFolder folder;
  int                 scenes = 0;
  for (const auto &entry : std::filesystem::directory_iterator(places::sources() + "/apps/scenes"))
    {
      const std::string extension = entry.path().extension().string();
      if (extension != ".prm" && extension != ".json")
        continue;
      INFO(entry.path());
      const Outcome outcome = run(folder.path(), {"check", entry.path().string()});
      INFO(outcome.err);
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.out, Contains("valid"));
      ++scenes;
    }
  CHECK(scenes >= 3);
}

TEST_CASE("Every scene that is shipped reads the same as it is completed in a result folder", "[apps]")
{
  const ScratchFolder folder;
  for (const auto &entry : std::filesystem::directory_iterator(places::sources() + "/apps/scenes"))
    {
      if (!entry.is_regular_file()) // tables, and designs of studies
        continue;
      INFO(entry.path());
      const apps::CheckedScene requested = apps::read_scene(entry.path().string(), {});
      const auto file = folder.file("scene.prm", completed_scene(*requested.root, apps::Completed::everything));
      const apps::CheckedScene again = apps::read_scene(file, {});
      CHECK(completed_scene(*again.root, apps::Completed::what_decides_results) ==
            completed_scene(*requested.root, apps::Completed::what_decides_results));
    }
}

TEST_CASE("The first scene that a reader runs ends without a warning", "[apps][slow]")
{
  const ScratchFolder folder;
  const Outcome       outcome = run(folder.path(), {"run", places::sources() + "/apps/scenes/quick_uniaxial.prm", "-o",
                                                    "results", "-s", "Output/Snapshots=0"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  CHECK_THAT(outcome.out, !Contains("warning"));
  CHECK_THAT(outcome.err, !Contains("note:"));
  const auto summary = nlohmann::json::parse(content_of(folder / "results/summary.json"));
  CHECK(summary["warnings"].empty());
  for (const auto &test : summary["tests"])
    CHECK(test["peak_passed"] == true);
}
