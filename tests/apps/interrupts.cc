#include "tests/apps/interrupted_runs.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <csignal>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** Slow enough to be interrupted in the middle, with a checkpoint after nearly every sample. */
  std::string slow_scene()
  {
    std::string scene = scene_with_file();
    scene             = replaced(scene, "set Strain rate = 4", "set Strain rate = 1");
    scene             = replaced(scene, "set Strain rate = 20", "set Strain rate = 5");
    return replaced(scene, "  set Samples   = 50", "  set Checkpoint interval = 0.01\n  set Samples = 50");
  }

  /** Results that must be equal to the last bit: everything but timings and pictures. */
  std::string reproducible_part(const std::filesystem::path &results)
  {
    std::string all;
    for (const char *folder : {"tension_particles", "tension_links", "compression_particles", "compression_links"})
      all += listing_of(results / folder);
    return all + content_of(results / "series.csv") + content_of(results / "tension_particles.pvd") +
           content_of(results / "compression_links.pvd");
  }

  /** The scene x.prm, stopped at the second snapshot of its links. */
  const InterruptedRun in_tension = {
    {"run", "x.prm"}, {"tension_links/tension_links_000001.vtp", "checkpoint.h5"}, reproducible_part};
} // namespace

TEST_CASE("An interrupted run checkpoints, leaves with 130, and goes on to the same bits", "[apps][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", slow_scene());
  goes_on_to_the_same_bits(folder, in_tension, {SIGINT, SIGTERM, SIGUSR1});
}

TEST_CASE("A killed run goes on from its last checkpoint to the same bits, weight and static start included",
          "[apps][slow][S13]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", slow_scene() + "subsection Gravity\n  set Acceleration = 0, 0, -1000\nend\n");
  goes_on_to_the_same_bits(folder, in_tension, {SIGKILL});
}

TEST_CASE("A run cannot be resumed with another scene, or where there is nothing to resume", "[apps][slow][S14]")
{
  const ScratchFolder folder;
  folder.file("packing.txt", stack_packing());
  folder.file("x.prm", slow_scene());
  const Outcome nothing = run(folder.path(), {"run", "x.prm", "-o", "results", "--resume"});
  CHECK(nothing.status == 2);
  CHECK_THAT(nothing.err, Contains("results: nothing to resume"));
  CHECK_FALSE(std::filesystem::exists(folder / "results"));

  REQUIRE(interrupted_run(folder, in_tension, SIGINT).status == 130);
  const std::string before = listing_of(folder / "results");
  const Outcome     other =
    run(folder.path(), {"run", "x.prm", "-o", "results", "--resume", "-s", "Material/CPM/Cohesion=4e6"});
  CHECK(other.status == 2);
  CHECK_THAT(other.err, Contains("Cohesion"));
  CHECK(listing_of(folder / "results") == before);
  // How often to checkpoint does not change the results, and may differ.
  CHECK(
    run(folder.path(), {"run", "x.prm", "-o", "results", "--resume", "-s", "Output/Checkpoint interval=100"}).status ==
    0);
}

namespace
{
  /** A run of the slow scene that was interrupted in the middle. */
  void leave_interrupted(const ScratchFolder &folder)
  {
    folder.file("packing.txt", stack_packing());
    folder.file("x.prm", slow_scene());
    REQUIRE(interrupted_run(folder, in_tension, SIGINT).status == 130);
  }

  /** Resuming is refused, the message names the file, and nothing is changed by that. */
  void resuming_is_refused_for(const ScratchFolder &folder, const std::string &name)
  {
    const std::string before  = listing_of(folder / "results");
    const Outcome     refused = run(folder.path(), {"run", "x.prm", "-o", "results", "--resume"});
    INFO(refused.err);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains(name) && Contains("--restart"));
    CHECK(listing_of(folder / "results") == before);
  }
} // namespace

TEST_CASE("The same command after an interruption does not throw the checkpoint away", "[apps][slow]")
{
  const ScratchFolder folder;
  leave_interrupted(folder);
  const std::string before  = listing_of(folder / "results");
  const Outcome     refused = run(folder.path(), {"run", "x.prm", "-o", "results"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("results/running") && Contains("--resume") && Contains("--restart"));
  CHECK(listing_of(folder / "results") == before);
  CHECK(run(folder.path(), {"run", "x.prm", "-o", "results", "--restart", "--resume"}).status == 2);
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results", "--restart"}).status == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "results/running"));
}

TEST_CASE("Resuming compares the content of input files, not their names", "[apps][slow]")
{
  const ScratchFolder folder;
  leave_interrupted(folder);
  const std::string packing = content_of(folder / "packing.txt");
  folder.file("packing.txt", packing + "0 0 0.1 1e-3\n");
  resuming_is_refused_for(folder, "packing.txt");
  folder.file("packing.txt", replaced(packing, "0.001", "0.0011")); // nearly the same length
  resuming_is_refused_for(folder, "packing.txt");
  folder.file("same.txt", packing);
  CHECK(run(folder.path(), {"run", "x.prm", "-o", "results", "--resume", "-s", "Specimen/File=same.txt"}).status == 0);
}

TEST_CASE("A series or snapshot that was changed or lost is noticed before a run goes on", "[apps][slow]")
{
  const ScratchFolder folder;
  leave_interrupted(folder);
  const auto in_progress = [&](const std::string &name) { return "results/running/" + name; };
  for (const std::string &name : {in_progress("series.csv"), in_progress("packing.h5"),
                                  in_progress("tension_particles/tension_particles_000000.vtp"),
                                  in_progress("tension_links/tension_links_000001.vtp")})
    {
      const std::string whole = content_of(folder / name);
      std::string       other = whole;
      other[other.size() / 3] = other[other.size() / 3] == '1' ? '2' : '1';
      folder.file(name, other);
      resuming_is_refused_for(folder, name);
      std::filesystem::remove(folder / name);
      const Outcome lost = run(folder.path(), {"run", "x.prm", "-o", "results", "--resume"});
      CHECK(lost.status == 2);
      CHECK_THAT(lost.err, Contains(name));
      folder.file(name, whole);
    }
  std::filesystem::remove(folder / in_progress("tension_particles.pvd")); // follows from the checkpoint: made anew
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results", "--resume"}).status == 0);
  CHECK(std::filesystem::exists(folder / "results/tension_particles.pvd"));
}

TEST_CASE("A run may be resumed with other entries of output", "[apps][slow]")
{
  const ScratchFolder folder;
  leave_interrupted(folder);
  SECTION("more of it")
  {
    REQUIRE(run(folder.path(),
                {"run", "x.prm", "-o", "results", "--resume", "-s", "Output/Samples=100", "-s", "Output/Snapshots=20"})
              .status == 0);
    CHECK_THAT(content_of(folder / "results/scene.prm"), Contains("set Samples = 100"));
  }
  SECTION("no snapshots any more")
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results", "--resume", "-s", "Output/Snapshots=0"}).status == 0);
  CHECK(std::filesystem::exists(folder / "results/summary.json"));
}
