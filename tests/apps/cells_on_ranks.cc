// Scenes with cells on several ranks and threads, and interrupted: the same bits.
#include "tests/apps/program.h"
#include "tests/apps/program_on_ranks.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <string>
#include <vector>

using namespace apps_tests;

namespace
{
  /** A coarse plate whose small cells damage. */
  std::string plate(const std::string &step)
  {
    return run_of("cells_at_hole.prm",
                  {"Mesh/Plate with hole/Radial divisions=3", "Mesh/Plate with hole/Angular divisions=4",
                   "Materials/solid/cells/Specimen/Generator/Cell particles=32", "Control/First step=" + step,
                   "Control/Largest step=" + step, "Control/End=1.2", "Output/Checkpoint interval=0.001",
                   "Materials/solid/cells/When localised=go on"});
  }

  void same_on_ranks(const ScratchFolder &folder, const std::string &words)
  {
    REQUIRE(shell_in(folder, program_on(0, 1) + words + " -o one") == 0);
    const std::string one = content_of(folder / "one/series.csv");
    REQUIRE(shell_in(folder, program_on(0, 2) + words + " -o threads") == 0);
    CHECK(content_of(folder / "threads/series.csv") == one);
    for (const int ranks : {1, 2, 3})
      {
        const std::string name = "ranks_" + std::to_string(ranks);
        INFO(name);
        const int status = shell_in(folder, program_on(ranks, ranks == 2 ? 2 : 1) + words + " -o " + name);
        INFO(content_of(folder / "said"));
        REQUIRE(status == 0);
        CHECK(content_of(folder / (name + "/series.csv")) == one);
        CHECK(std::filesystem::exists(folder / (name + "/solid/solid_000001.vtu")));
      }
  }
} // namespace

TEST_CASE("Cells that damage give a structure the same bits on any number of ranks and threads",
          "[apps][mpi][cells][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  same_on_ranks(folder, plate("0.2"));
}

TEST_CASE("More ranks than cells give the same bits and print what one does", "[apps][mpi][cells][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  const std::string   changes =
    run_of("cells_at_hole.prm",
           {"Mesh/Source=box", "Mesh/Box/Size=0.1, 0.1, 0", "Mesh/Box/Divisions x=1", "Mesh/Box/Divisions y=1",
            "Materials/solid/cells/Specimen/Generator/Cell particles=32", "Materials/solid/cells/When localised=go on",
            "Control/First step=0.5", "Control/Largest step=0.5", "Control/End=4"})
      .substr(4); // without the command: four points of one element
  REQUIRE(shell_in(folder, program_on(0, 1) + " run" + changes + " -o one") == 0);
  REQUIRE(shell_in(folder, program_on(5, 1) + " run" + changes + " -o five") == 0);
  CHECK(content_of(folder / "five/series.csv") == content_of(folder / "one/series.csv"));
  CHECK_THAT(content_of(folder / "one/series.csv"), Catch::Contains("points_promoted"));
  // They try states until one of their clocks says that it is enough.
  CHECK(shell_in(folder, program_on(3, 1) + " check" + changes +
                           " -s Control/End=4 -s 'Control/First step=0.001' -s 'Control/Largest step=0.001'") == 0);
  CHECK_THAT(content_of(folder / "said"), Catch::Contains("duration"));
}

TEST_CASE("Cells in motion give a structure the same bits on any number of ranks and threads",
          "[apps][mpi][cells][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  same_on_ranks(folder, run_of("three_cubes.prm", {"Motion/End time=0.02", "Output/Snapshots=2"}));
}

TEST_CASE(
  "A scene with cells that is interrupted goes on to the same bits, on one rank and on two, and on no other number",
  "[apps][mpi][cells][slow][S13]")
{
  const ScratchFolder folder;
  const std::string   words = plate("0.02");
  REQUIRE(shell_in(folder, program_on(0, 1) + words + " -o whole") == 0);
  const std::string whole = content_of(folder / "whole/series.csv");
  for (const int ranks : {0, 2})
    {
      if (ranks > 0 && places::skipped_without_mpirun())
        return;
      const std::string name = "ranks_" + std::to_string(ranks), into = words + " -o " + name;
      // Not before there are promoted cells to save: some of the ten snapshots are then written.
      shell_in(folder, program_on(ranks, 1, noting_its_process) + into + " & while kill -0 $! && { [ ! -e " + name +
                         "/running/checkpoint.h5 ] || [ ! -e " + name +
                         "/running/solid/solid_000006.vtu ]; }; do sleep 0.01; done; " + interrupt_noted + "; wait $!");
      INFO(content_of(folder / "said"));
      REQUIRE_FALSE(std::filesystem::exists(folder / (name + "/summary.json")));
      if (ranks == 2)
        {
          // Each rank has saved its own points: others cannot go on with them, and nothing is lost by the attempt.
          CHECK(shell_in(folder, program_on(0, 1) + words + " -o " + name + " --resume") != 0);
          CHECK_THAT(content_of(folder / "said"),
                     Catch::Contains("was written by 2 ranks, and there are 1 now. Start as many."));
        }
      REQUIRE(shell_in(folder, program_on(ranks, 1) + into + " --resume") == 0);
      CHECK(content_of(folder / (name + "/series.csv")) == whole);
    }
}
