#include "tests/apps/program.h"
#include "tests/apps/scenes.h"
#include "tests/apps/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  void prepare(const ScratchFolder &folder)
  {
    folder.file("packing.txt", pair_packing());
    folder.file("x.prm", scene_with_file());
  }
} // namespace

TEST_CASE("An output folder that cannot be made is refused with the reason", "[apps][S14]")
{
  const ScratchFolder folder;
  prepare(folder);
  folder.file("taken", "somebody's file");
  const Outcome under_file = run(folder.path(), {"run", "x.prm", "-o", "taken/results"});
  CHECK(under_file.status == 2);
  CHECK_THAT(under_file.err, Contains("taken/results: the output folder cannot be made: Not a directory"));
  CHECK(content_of(folder / "taken") == "somebody's file");
  // /proc refuses new folders even to the superuser, for whom permissions do not count.
  const Outcome refused = run(folder.path(), {"run", "x.prm", "-o", "/proc/results"});
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("/proc/results: the output folder cannot be made"));
}

TEST_CASE("Bad input leaves earlier results as they were", "[apps][S14]")
{
  const ScratchFolder folder;
  prepare(folder);
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results"}).status == 0);
  const std::string before = listing_of(folder / "results");
  CHECK(run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Material/CPM/Cohesion=-1"}).status == 2);
  CHECK(run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Loading/Grip thickness=1"}).status == 2);
  CHECK(run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Specimen/File=none.txt"}).status == 2);
  CHECK(listing_of(folder / "results") == before);
}

TEST_CASE("A full disk ends the run with one message and leaves earlier results as they were", "[apps][S14]")
{
  const ScratchFolder folder;
  prepare(folder);
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results"}).status == 0);
  const std::string before = listing_of(folder / "results");
  // The scene fits into 4 kB, the series does not.
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Output/Samples=1000"}, 4096);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("results/running") && Contains("File too large"));
  std::filesystem::remove_all(folder / "results" / "running");
  CHECK(listing_of(folder / "results") == before);
}

TEST_CASE("Two runs cannot write to one folder at a time", "[apps]")
{
  const ScratchFolder folder;
  prepare(folder);
  std::filesystem::create_directory(folder / "results");
  const int descriptor = open((folder / "results").c_str(), O_RDONLY | O_DIRECTORY);
  REQUIRE(flock(descriptor, LOCK_EX | LOCK_NB) == 0);
  const Outcome outcome = run(folder.path(), {"run", "x.prm", "-o", "results"});
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("results: another run is writing to this folder"));
  close(descriptor);
  CHECK(run(folder.path(), {"run", "x.prm", "-o", "results"}).status == 0);
}

TEST_CASE("A new run replaces the results of the one before, snapshots included", "[apps]")
{
  const ScratchFolder folder;
  prepare(folder);
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results"}).status == 0);
  REQUIRE(std::filesystem::exists(folder / "results/tension_particles/tension_particles_000004.vtp"));
  REQUIRE(run(folder.path(), {"run", "x.prm", "-o", "results", "-s", "Output/Snapshots=2"}).status == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "results/tension_particles/tension_particles_000004.vtp"));
  CHECK_FALSE(std::filesystem::exists(folder / "results/running"));
}
