// What `breccia check` says of the time that a run will take.
#include "apps/forecasts/duration.h"
#include "apps/runs/particles/piled_up.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/environment.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  /** What check says of shipped scenes, each with these words behind it. */
  std::vector<std::string> forecasts_of(const std::vector<std::string> &scenes,
                                        const std::vector<std::string> &words = {})
  {
    const ScratchFolder      folder;
    std::vector<std::string> said;
    for (const std::string &scene : scenes)
      {
        std::vector<std::string> command = {"check", places::sources() + "/apps/scenes/" + scene};
        command.insert(command.end(), words.begin(), words.end());
        const Outcome outcome = run(folder.path(), command);
        INFO(scene << "\n" << outcome.out << outcome.err);
        CHECK(outcome.status == 0);
        said.push_back(outcome.out);
      }
    return said;
  }
} // namespace

TEST_CASE("Work that ends before enough of it is measured has the cost of what was done", "[apps]")
{
  std::int64_t left  = 100;
  const auto   spend = [&left](const std::int64_t count) {
    const std::int64_t done = std::min(left, count);
    left -= done;
    return done;
  };
  CHECK(apps::seconds_per_unit(spend) > 0);
  CHECK(apps::seconds_per_unit(spend) == 0); // nothing is left to do
}

TEST_CASE("check says how long a cell and a sequential scene take, and never less than nothing", "[apps][slow]")
{
  for (const std::string &said : forecasts_of({"periodic_cell.prm", "transfer_compression.prm"}))
    CHECK_THAT(said, Contains("duration     roughly ") && !Contains("roughly -"));
}

TEST_CASE("check counts what a run writes: a million snapshots take longer than the few steps between them", "[apps]")
{
  for (const std::string &said :
       forecasts_of({"bouncing_sphere.prm", "beam_and_spheres.prm"},
                    {"-s", "Time/End time=1e-3", "-s", "Output/Samples=1000000", "-s", "Output/Snapshots=1000000"}))
    CHECK_THAT(said, Contains("duration     roughly ") && !Contains(" s, on this machine")); // a minute or more
}

TEST_CASE("check says the longest duration of a run that a stop condition may end, and the shortest where it waits",
          "[apps][slow]")
{
  for (const std::string &said : forecasts_of(
         {"notched_beam.prm"}, {"-s", "Control/Stop fraction=0.2", "-s", "Mesh/Notched beam/Fine size=0.002"}))
    CHECK_THAT(said, Contains("duration     at most "));
  // A short one is tried to its end.
  for (const std::string &said : forecasts_of({"snap_back.prm"}, {"-s", "Control/Stop fraction=0.9"}))
    CHECK_THAT(said, Contains("duration     roughly "));
  for (const std::string &said : forecasts_of({"bonded_beam.prm"}))
    CHECK_THAT(said, Contains("duration     from ") && Contains(" s to "));
  for (const std::string &said : forecasts_of({"bonded_beam.prm"}, {"-s", "Stop/equilibrium/From time=0"}))
    CHECK_THAT(said, Contains("duration     at most "));
}

TEST_CASE("check says that local damping slows the fall of particles without bonds, and only theirs", "[apps]")
{
  const std::string slowed = "what falls freely falls at ";
  const std::string damped = forecasts_of({"bouncing_sphere.prm"}, {"-s", "Time/Damping=0.7"}).front();
  CHECK_THAT(damped, Contains(slowed + "0.3 of the acceleration, for 1.83 of the time"));
  const std::string free   = forecasts_of({"bouncing_sphere.prm"}).front();
  const std::string bonded = forecasts_of({"bonded_beam.prm"}, {"-s", "Time/Damping=0.7"}).front();
  CHECK_THAT(free, !Contains(slowed));
  CHECK_THAT(bonded, !Contains(slowed));
}

TEST_CASE("check forecasts without a folder for temporary files", "[apps]")
{
  const ScratchFolder folder;
  const Environment   nowhere("TMPDIR", (folder / "nowhere").string());
  const Outcome       outcome = run(folder.path(), {"check", places::sources() + "/apps/scenes/bouncing_sphere.prm"});
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("duration     roughly "));
}

TEST_CASE("check seeks the sharp critical step of small specimens alone, and says so of a large one", "[apps][slow]")
{
  const ScratchFolder folder;
  folder.file("x.prm", replaced(scene_with_file(), "set Snapshots = 5", "set Snapshots = 0"));
  const auto checked = [&](const int layers) {
    std::string text;
    for (int i = 0; i < 61 * 61 * layers; ++i)
      text += std::to_string(2 * (i % 61)) + "e-3 " + std::to_string(2 * (i / 61 % 61)) + "e-3 " +
              std::to_string(2 * (i / 3721)) + "e-3 1e-3\n";
    folder.file("packing.txt", text);
    const Outcome outcome = run(folder.path(), {"check", "x.prm", "-s", "Loading/Tests=tension"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome.out;
  };
  CHECK_THAT(checked(3), Contains("would be critical: sharp"));
  CHECK_THAT(checked(54),
             Contains("particles    200934") && Contains("sharp bound is sought of at most 200000 particles"));
}

TEST_CASE("check promises no duration of cells that may break", "[apps]")
{
  for (const std::string &said : forecasts_of({"cells_at_hole.prm"}))
    CHECK_THAT(said, Contains("duration     at least ") && Contains("cells whose links break take longer"));
}

TEST_CASE("What particles would do after the end of a run is no part of its forecast", "[apps]")
{
  // Away from the anvil, 0.5 mm by the end; after half a second, metres in a step.
  forecasts_of({"bouncing_sphere.prm"}, {"-s", "Gravity/Acceleration=0, 0, 1e5", "-s", "Time/End time=1e-4"});
}

TEST_CASE("Particles piled up for a forecast touch their neighbours and a box, and apart nothing", "[apps]")
{
  dem::LinearContactParameters contact;
  contact.effective_modulus = 1e7;
  for (const int dimension : {2, 3})
    {
      dem::SpecimenParameters p;
      p.physics.dimension = dimension;
      p.thickness         = dimension == 2 ? 0.01 : 0;
      p.density           = 2500;
      p.interaction_ratio = 1;
      const apps::LatticeOfParticles lattice{p, contact, dimension == 2 ? 36u : 216u, 0.005, contact};
      dem::Specimen                  pile = lattice.piled_up(), apart = lattice.apart();
      pile.advance(1);
      apart.advance(1);
      const dem::Counts touching = pile.counts(), free = apart.counts();
      CHECK(touching.particles == lattice.number);
      CHECK(touching.contacts == (dimension == 2 ? 2 * 6 * 5 : 3 * 36 * 5));
      CHECK(touching.wall_contacts >= (dimension == 2 ? 16u : 136u)); // below and on all sides
      CHECK(free.particles == lattice.number);
      CHECK(free.contacts + free.wall_contacts == 0);
    }
}
