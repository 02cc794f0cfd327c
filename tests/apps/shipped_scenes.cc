#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

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
