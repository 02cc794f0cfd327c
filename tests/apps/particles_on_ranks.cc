// Scenes of particles on several ranks: every file but the summary's cost has the same bytes as on one.
#include "tests/apps/program.h"
#include "tests/apps/same_on_ranks.h"
#include "tests/apps/scratch_folder.h"
#include "tests/environment.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** A cube of concrete of 768 particles, pulled and crushed. */
  std::string small_concrete() { return run_of("concrete_uniaxial.prm", {"Specimen/Box size=0.02, 0.02, 0.02"}); }

  /** A ball falls on a beam of particles, which presses supports of elements from 3.5e-4 s on: until the ball has come back. */
  std::string past_the_blow() { return run_of("drop_weight.prm", {"Time/End time=6e-4", "Output/Samples=150"}); }

  /** A window of mortar that grows in a hurry, and is pressed a little. */
  std::string small_mortar(const std::string &size)
  {
    return run_of("mortar_window.prm",
                  {"Specimen/Genesis/Size=" + size, "Specimen/Genesis/Increments=10",
                   "Specimen/Genesis/Solve steps=500", "Laboratory/Largest strain=1e-5", "Output/Snapshots=1"});
  }

  nlohmann::json summary_of(const std::filesystem::path &folder)
  {
    return nlohmann::json::parse(content_of(folder / "summary.json"));
  }

  void same_on_ranks(const ScratchFolder &folder, const std::string &words, const std::vector<std::array<int, 2>> &ways)
  {
    const int alone = shell_in(folder, program_on(0, 1) + words + " -o one");
    INFO(content_of(folder / "said"));
    REQUIRE(alone == 0);
    const auto figures = summary_of(folder / "one")["figures"];
    CHECK_FALSE(figures.is_null());
    for (const auto &[ranks, threads] : ways)
      {
        const std::string name = std::to_string(ranks) + "_ranks";
        INFO(name);
        const int status = shell_in(folder, program_on(ranks, threads) + words + " -o " + name);
        INFO(content_of(folder / "said"));
        REQUIRE(status == 0);
        CHECK(differences(folder / "one", folder / name) == std::vector<std::string>());
        CHECK(summary_of(folder / name)["figures"] == figures);
        CHECK(summary_of(folder / name)["ranks"].size() == static_cast<std::size_t>(ranks));
      }
  }

} // namespace

TEST_CASE("A cell has the same results on one rank and on three", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  same_on_ranks(folder, run_of("periodic_cell.prm", {"Output/Snapshots=2"}), {{{3, 1}}});
}

TEST_CASE("Concrete pulled and crushed has the same results on any number of ranks and threads",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  same_on_ranks(folder, small_concrete(), {{{2, 2}}, {{3, 1}}, {{4, 1}}, {{8, 1}}});
  CHECK(occurrences("faces of the specimen are cut", content_of(folder / "said")) == 1);
}

TEST_CASE("Pressed spheres, rocks and bodies that tumble have the same results on ranks", "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  for (const std::string &scene :
       {run_of("pressed_spheres.prm"), run_of("rock_tension.prm"), run_of("jointed_network.prm"),
        run_of("tumbling_bodies.prm", {"Time/End time=0.25"})})
    {
      INFO(scene);
      const ScratchFolder folder;
      same_on_ranks(folder, scene, {{{3, 1}}});
    }
}

TEST_CASE(
  "Particles beside solids have the same results on ranks: surfaces in the same steps and in several, glue, handshakes",
  "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  for (const char *scene : {"beam_and_spheres.prm", "drop_weight.prm", "plate_impact.prm", "beam_with_core.prm"})
    {
      INFO(scene);
      const ScratchFolder folder;
      same_on_ranks(folder, run_of(scene), {{{3, 1}}});
    }
}

TEST_CASE("What ranks say to each other is the same on all, whatever is written and read", "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const std::string comparing = "BRECCIA_CHECK_RANKS=1 ";
  for (const std::string &scene :
       {small_concrete() + " -s 'Output/Checkpoint interval=0.5'", run_of("rock_tension.prm"),
        run_of("drop_weight.prm"), run_of("periodic_cell.prm", {"Output/Snapshots=3"})})
    {
      INFO(scene);
      const ScratchFolder folder;
      const int           status = shell_in(folder, comparing + program_on(2, 1) + scene + " -o results");
      INFO(content_of(folder / "said"));
      CHECK(status == 0);
    }
}

TEST_CASE("Solids of cells beside particles refuse mpirun in one message", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  CHECK(shell_in(folder, program_on(2, 1) + run_of("cells_under_ball.prm") + " -o results") != 0);
  const std::string said = content_of(folder / "said");
  CHECK(occurrences("runs in one process, and mpirun has started 2", said) == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "results"));
}

TEST_CASE("A run that was interrupted on three ranks goes on on one, on five and on eight to the same results",
          "[apps][mpi][ranks][slow][S13]")
{
  if (places::skipped_without_mpirun())
    return;
  for (const std::string &scene : {small_concrete(), past_the_blow()})
    {
      INFO(scene);
      goes_on_on_others(scene, {5, 8});
    }
}

TEST_CASE("Where the first rank cannot write, all ranks are gone in a moment with one message",
          "[apps][mpi][ranks][slow][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  // The folder is taken away under the run, before its next snapshot.
  are_gone_where_one_cannot_write(small_concrete(), "tension_links/tension_links_000001.vtp", "rm -rf results/running",
                                  "does not exist");
}

TEST_CASE("A beam of fewer bricks than ranks leaves the same state and pictures on ranks", "[apps][mpi][ranks]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  same_on_ranks(folder, run_of("bonded_beam.prm", {"Time/End time=0.01", "Output/Snapshots=0"}), {{{3, 1}}});
  for (const char *left : {"state.h5", "packing_at_end.h5", "crack.png", "forces.png"})
    CHECK(std::filesystem::exists(folder / "3_ranks" / left));
}

TEST_CASE("Where the first rank cannot write the state at the end, all ranks are gone in a moment with one message",
          "[apps][mpi][ranks][slow][S14]")
{
  if (places::skipped_without_mpirun())
    return;
  // Another thing has its name.
  are_gone_where_one_cannot_write(small_concrete(), "tension_links/tension_links_000000.vtp",
                                  "mkdir results/running/tension_state.h5", "tension_state.h5");
}

TEST_CASE("A mortar grown on ranks is that of one, on from a checkpoint and out of the first rank's cache too",
          "[apps][mpi][ranks][genesis][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  const Environment   caches("XDG_CACHE_HOME", (folder / "caches").string());
  const std::string   words = small_mortar("0.02, 0.02, 0");
  const auto          made  = [&](const std::string &program, const std::string &name, const std::string &more) {
    const int status = shell_in(folder, program + words + more + " -o " + name);
    INFO(content_of(folder / "said"));
    CHECK(status == 0);
  };
  made(program_on(0, 1), "one", " --no-cache");
  made("BRECCIA_CHECK_RANKS=1 " + program_on(3, 1), "three", "");
  CHECK(differences(folder / "one", folder / "three") == std::vector<std::string>());
  CHECK_FALSE(std::filesystem::is_empty(folder / "caches"));
  // The first rank has a cache, the others none.
  made(program_on(2, 1, "sh -c '[ ${OMPI_COMM_WORLD_RANK:-0} = 0 ] || export XDG_CACHE_HOME=none; exec \"$@\"' sh "),
       "kept", "");
  CHECK(differences(folder / "one", folder / "kept") == std::vector<std::string>());
  std::filesystem::remove_all(folder / "caches");
  goes_on_on_others(small_mortar("0.04, 0.03, 0") + " --no-cache");
}
