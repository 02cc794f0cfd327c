// What `breccia check` says of the time that a run will take.
#include "apps/drivers/parts/duration.h"
#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace apps_tests;
using Catch::Contains;

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
  const ScratchFolder folder;
  for (const char *scene : {"periodic_cell.prm", "transfer_compression.prm"})
    {
      const Outcome outcome = run(folder.path(), {"check", places::sources() + "/apps/scenes/" + scene});
      INFO(outcome.out << outcome.err);
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.out, Contains("duration     roughly ") && !Contains("roughly -"));
    }
}

TEST_CASE("check counts what a run writes: a million snapshots take longer than the few steps between them", "[apps]")
{
  const ScratchFolder folder;
  for (const char *scene : {"bouncing_sphere.prm", "beam_and_spheres.prm"})
    {
      const Outcome outcome =
        run(folder.path(), {"check", places::sources() + "/apps/scenes/" + scene, "-s", "Time/End time=1e-3", "-s",
                            "Output/Samples=1000000", "-s", "Output/Snapshots=1000000"});
      INFO(outcome.out << outcome.err);
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.out,
                 Contains("duration     roughly ") && !Contains(" s, on this machine")); // a minute or more
    }
}

TEST_CASE("check says the longest duration of a run that a stop condition may end", "[apps]")
{
  const ScratchFolder folder;
  for (const char *scene : {"bonded_beam.prm", "snap_back.prm"})
    {
      const Outcome outcome = run(folder.path(), {"check", places::sources() + "/apps/scenes/" + scene});
      INFO(outcome.out << outcome.err);
      CHECK(outcome.status == 0);
      CHECK_THAT(outcome.out, Contains("duration     at most "));
    }
}
