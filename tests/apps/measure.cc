// breccia measure: means over the state that a run left.
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace apps_tests;
using Catch::Contains;

TEST_CASE("breccia measure prints stress, fabric, coordination and damage of the state that a test left", "[apps]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("stack.prm", scene_with_file());
  REQUIRE(
    run(folder.path(), {"run", "stack.prm", "-o", "out", "-s", "Loading/Tests=tension", "-s", "Output/Snapshots=0"})
      .status == 0);
  const Outcome outcome = run(folder.path(), {"measure", "out/tension_state.h5", "-o", "measured"});
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("particles              175") && Contains("fabric, links made") &&
                            Contains("1094 made") && Contains("stress"));
  const auto json = nlohmann::json::parse(content_of(folder / "measured/measured.json"));
  CHECK(json["particles"] == 175);
  CHECK(json["mean_damage"]["value"].get<double>() > 0);
  double trace = 0;
  for (const char *part : {"xx", "yy", "zz"})
    trace += json["fabric"]["made"][part].get<double>();
  CHECK(trace == Approx(1));

  CHECK_THAT(run(folder.path(), {"measure", "out/tension_state.h5", "--box", "1", "0", "0", "1", "0", "1"}).err,
             Contains("--box") && Contains("along x"));
  const Outcome none = run(folder.path(), {"measure", "out/tension_state.h5", "--box", "1", "2", "1", "2", "1", "2"});
  CHECK(none.status == 2);
  CHECK_THAT(none.err, Contains("no particle in the box"));
  CHECK(run(folder.path(), {"measure", "nowhere.h5"}).status == 2);
}
