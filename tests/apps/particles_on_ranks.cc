// Scenes of particles on several ranks: every file but the summary's cost has the same bytes as on one.
#include "tests/apps/program.h"
#include "tests/apps/same_on_ranks.h"
#include "tests/apps/scratch_folder.h"
#include "tests/environment.h"
#include "tests/places.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
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

  /** A laboratory's test on rock, until some bonds have broken. */
  std::string tried_rock(const std::string &scene, const std::vector<std::string> &more)
  {
    std::vector<std::string> changes = {"Laboratory/Ramp steps=400", "Laboratory/Rest=1e-2",
                                        "Laboratory/Rest steps=500", "Laboratory/Speed=1", "Output/Snapshots=1"};
    changes.insert(changes.end(), more.begin(), more.end());
    return run_of(scene, changes);
  }

  /** The same of 609 spheres in a cylinder, three bricks. */
  std::string tried_cylinder(const std::string &scene, const std::vector<std::string> &more)
  {
    std::vector<std::string> changes = {"Specimen/Source=file",
                                        "Specimen/File=" + places::sources() + "/meshes/cylinder_packing.txt",
                                        "Specimen/Interaction ratio=1.2", "Laboratory/Largest strain=2e-3"};
    changes.insert(changes.end(), more.begin(), more.end());
    return tried_rock(scene, changes);
  }

  /** A beam of mortar with a grain of stone, its ends of stone too, of 659 particles, three bricks. */
  std::string small_grain()
  {
    return run_of("two_materials.prm", {"Specimen/Box size=0.03, 0.03, 0.02", "Regions/low end/Upper=0.03, 0.03, 0.005",
                                        "Regions/high end/Lower=0, 0, 0.015", "Regions/high end/Upper=0.03, 0.03, 0.02",
                                        "Regions/grain/Centre=0.01, 0.015, 0.01", "Output/Snapshots=2"});
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

TEST_CASE("A membrane, a jacket and walls press rock alike on ranks", "[apps][mpi][ranks][laboratory][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  for (const auto &[scene, ranks, threads] : std::vector<std::tuple<std::string, int, int>>{
         {tried_cylinder("rock_triaxial.prm", {"Laboratory/Membrane steps=100"}), 3, 1},
         {tried_rock("rock_biaxial.prm", {"Laboratory/Confinement=membrane", "Laboratory/Largest strain=3e-4"}), 3, 1},
         {tried_cylinder("rock_cylinder.prm",
                         {"Laboratory/Platens=outermost particles", "Laboratory/Confining pressure=1e6"}),
          3, 1},
         {tried_rock("rock_triaxial.prm", // walls that servos hold
                     {"Laboratory/Confinement=walls", "Laboratory/Rest steps=100", "Laboratory/Largest strain=3e-4",
                      "Material/parallel-bond/Tensile strength=2e6", "Material/parallel-bond/Cohesion=4e6"}),
          2, 2}})
    {
      INFO(scene);
      const ScratchFolder folder;
      same_on_ranks(folder, scene, {{{ranks, threads}}});
      CHECK(content_of(folder / "one/breaks.csv").size() > 400); // some lines beside its head
    }
}

TEST_CASE("Concrete that flows and takes its time, and grains of Hertz and Mindlin, have the same results on ranks",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  for (const std::string &scene :
       {run_of("concrete_uniaxial.prm",
               {"Specimen/Box size=0.02, 0.02, 0.02", "Material/CPM/Compression yield strain=-1e-3",
                "Material/CPM/Damage time=1e-5", "Material/CPM/Plastic time=1e-5",
                "Material/CPM/Strength surface=logarithmic", "Loading/Tension/Strain rate=4",
                "Loading/Compression/Strain rate=20", "Output/Snapshots=1"}),
        run_of("pressed_spheres.prm",
               {"Specimen/Source=generator", "Specimen/Box size=0.046, 0.046, 0.1",
                "Specimen/Generator/Particle radius=0.003", "Walls/piston/Corner=0, 0, 0.1",
                "Material/Law=hertz-mindlin", "Material/hertz-mindlin/Young modulus=1e7",
                "Material/hertz-mindlin/Friction coefficient=0.3", "Material/hertz-mindlin/Restitution=0.8",
                "Time/End time=0.05", "Output/Snapshots=1"})})
    {
      INFO(scene);
      const ScratchFolder folder;
      same_on_ranks(folder, scene, {{{3, 1}}});
    }
}

TEST_CASE("Two materials have the same results on ranks, and the summary says of each rank what it has and has sent",
          "[apps][mpi][ranks][slow]")
{
  if (places::skipped_without_mpirun())
    return;
  const ScratchFolder folder;
  same_on_ranks(folder, small_grain(), {{{3, 1}}});
  const nlohmann::json one = summary_of(folder / "one"), three = summary_of(folder / "3_ranks");
  for (const char *same : {"energy", "material_pairs", "materials"})
    CHECK(three[same] == one[same]);
  CHECK(three["tests"][0]["link_classes"] == one["tests"][0]["link_classes"]);
  std::map<std::string, std::int64_t> sums;
  for (const nlohmann::json &rank : three["ranks"])
    for (const char *key :
         {"particles", "links", "copied_links", "wall_contacts", "ghosts", "neighbours", "messages", "bytes", "memory"})
      {
        INFO(key);
        REQUIRE(rank[key].is_number_integer());
        sums[key] += rank[key].get<std::int64_t>();
      }
  CHECK(sums["particles"] == one["cost"]["particles"]);
  REQUIRE(one["tests"][0]["broken_links"] == 0);
  REQUIRE(one["tests"][0]["contacts"] == 0);
  CHECK(sums["links"] == one["cost"]["links"]);
  CHECK(sums["copied_links"] > 0);
  CHECK(sums["copied_links"] < sums["links"]);
  CHECK(sums["wall_contacts"] == 0);
  CHECK(sums["ghosts"] > 0);
  CHECK(sums["neighbours"] == 6);
  CHECK(sums["messages"] > 2 * one["tests"][0]["steps"].get<std::int64_t>());
  CHECK(sums["bytes"] > sums["messages"]);
}
