#include "apps/specimens/packing_cache.h"

#include "postprocess/packings/packing_io.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"
#include "tests/environment.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <set>
#include <vector>

using namespace apps_tests;

namespace
{
  namespace fs = std::filesystem;

  dem::CompactionParameters spheres(const std::uint64_t seed)
  {
    dem::CompactionParameters p;
    p.radius   = 1.0 / 3;
    p.count    = 40;
    p.seed     = seed;
    p.friction = 0.1;
    return p;
  }

  std::vector<fs::path> files_below(const fs::path &folder)
  {
    std::vector<fs::path> files;
    if (fs::exists(folder))
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
          files.push_back(entry.path());
    return files;
  }

  /** Change one byte in the middle. */
  void damage(const fs::path &file)
  {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto   middle = static_cast<std::streamoff>(fs::file_size(file) / 2);
    bytes.seekg(middle);
    const char byte = static_cast<char>(bytes.get());
    bytes.seekp(middle);
    bytes.put(static_cast<char>(~byte));
  }

  void age(const fs::path &file, const int hours)
  {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
} // namespace

TEST_CASE("a packing comes out of the cache to the last bit, with all that is known of it", "[apps][packing_cache]")
{
  const ScratchFolder         folder;
  const apps::PackingCache    cache(apps::CacheFolder(folder / "not" / "there" / "yet"));
  const dem::CompactionResult made = dem::compact(spheres(1));
  REQUIRE_FALSE(cache.find(spheres(1)));
  cache.keep(spheres(1), made);
  const auto kept = cache.find(spheres(1));
  REQUIRE(kept);
  CHECK(kept->packing.centre == made.packing.centre);
  CHECK(kept->packing.radius == made.packing.radius);
  CHECK(kept->packing.periodic_cell == made.packing.periodic_cell);
  CHECK(kept->packing_fraction == made.packing_fraction);
  CHECK(kept->mean_overlap == made.mean_overlap);
  CHECK(kept->unbalanced_ratio == made.unbalanced_ratio);
  CHECK(kept->coordination == made.coordination);
  CHECK(kept->steps == made.steps);
  CHECK(files_below(folder.path()).size() == 1); // nothing half-written beside it
}

TEST_CASE("every parameter of a packing distinguishes it from others in the cache", "[apps][packing_cache]")
{
  using P = dem::CompactionParameters;
  const apps::PackingCache cache(apps::CacheFolder("/nowhere"));
  std::vector<P>           others(12, spheres(1));
  others[0].radius            = std::nextafter(others[0].radius, 1.0);
  others[1].count             = 41;
  others[2].seed              = 2;
  others[3].proportions.z()   = 2;
  others[4].friction          = 0.2;
  others[5].damping           = 0.5;
  others[6].shear_ratio       = 0.2;
  others[7].initial_spacing   = 2.9;
  others[8].high_pressure     = 0.2;
  others[9].low_pressure      = 2e-3;
  others[10].time_step_factor = 0.9;
  others[11].step_limit       = 1;
  others.push_back(spheres(1));
  std::set<fs::path> names;
  for (const P &each : others)
    names.insert(cache.file_of(each));
  CHECK(names.size() == others.size());
}

TEST_CASE("a damaged, cut or foreign file in the cache is as if it were not there, and is replaced",
          "[apps][packing_cache]")
{
  const ScratchFolder         folder;
  const apps::PackingCache    cache(apps::CacheFolder(folder.path()));
  const dem::CompactionResult made = dem::compact(spheres(1));
  cache.keep(spheres(1), made);
  const fs::path file = cache.file_of(spheres(1));

  SECTION("one byte of its centres") { damage(file); }
  SECTION("cut") { fs::resize_file(file, fs::file_size(file) / 2); }
  SECTION("empty") { fs::resize_file(file, 0); }
  SECTION("text") { std::ofstream(file) << "no packing"; }
  SECTION("of other parameters")
  {
    cache.keep(spheres(2), dem::compact(spheres(2)));
    fs::rename(cache.file_of(spheres(2)), file);
  }
  CHECK_FALSE(cache.find(spheres(1)));
  cache.keep(spheres(1), made);
  REQUIRE(cache.find(spheres(1)));
  CHECK(cache.find(spheres(1))->packing.centre == made.packing.centre);
}

TEST_CASE("a cache that grows too large drops the least recently used packings", "[apps][packing_cache]")
{
  const ScratchFolder         folder;
  const dem::CompactionResult made = dem::compact(spheres(1));
  apps::PackingCache(apps::CacheFolder(folder.path())).keep(spheres(1), made);
  const std::uintmax_t     one = fs::file_size(files_below(folder.path()).front());
  const apps::PackingCache cache(apps::CacheFolder(folder.path(), 3 * one + one / 2)); // room for three
  for (const std::uint64_t seed : {2, 3})
    cache.keep(spheres(seed), made);
  age(cache.file_of(spheres(1)), 3);
  age(cache.file_of(spheres(2)), 2);
  age(cache.file_of(spheres(3)), 1);
  CHECK(cache.find(spheres(1))); // which makes it the youngest
  cache.keep(spheres(4), made);
  CHECK(cache.find(spheres(1)));
  CHECK_FALSE(cache.find(spheres(2)));
  CHECK(cache.find(spheres(3)));
  CHECK(cache.find(spheres(4)));
}

TEST_CASE("the program takes a packing that it has made before from the user's cache, and with --no-cache does not",
          "[apps][packing_cache]")
{
  const ScratchFolder folder;
  const Environment   caches("XDG_CACHE_HOME", (folder / "caches").string());
  const auto          pack = [&](std::vector<std::string> words, const std::string &file) {
    words.insert(words.begin(), {"pack", "--radius", "2e-3", "--count", "64", "-o", file});
    REQUIRE(run(folder.path(), words).status == 0);
    return postprocess::read_packing(folder / file);
  };
  const dem::Packing without = pack({"--no-cache"}, "without.txt");
  CHECK(files_below(folder / "caches").empty());
  const dem::Packing made = pack({}, "made.txt");
  CHECK(made.centre == without.centre);
  const std::vector<fs::path> kept = files_below(folder / "caches");
  REQUIRE(kept.size() == 1);
  CHECK(kept.front().parent_path() == folder / "caches" / "breccia" / "packings");

  // That it is taken from there shows where another packing lies in its place, under its key.
  const apps::PackingCache  cache(apps::CacheFolder(kept.front().parent_path()));
  dem::CompactionParameters parameters;
  parameters.radius             = 2e-3;
  parameters.count              = 64;
  dem::CompactionResult another = *cache.find(parameters);
  another.packing.centre.front() += Eigen::Vector3d(1e-4, 0, 0);
  cache.keep(parameters, another);
  CHECK(pack({}, "taken.txt").centre == another.packing.centre);
  CHECK(pack({"--no-cache"}, "anew.txt").centre == without.centre);
}

TEST_CASE("a cache folder that cannot be written changes nothing but the time", "[apps][packing_cache]")
{
  const ScratchFolder folder;
  const Environment   caches("XDG_CACHE_HOME", (folder / "a_file").string());
  folder.file("a_file", "");
  const Outcome outcome = run(folder.path(), {"pack", "--radius", "2e-3", "--count", "64", "-o", "p.txt"});
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(postprocess::read_packing(folder / "p.txt").size() == 64);
}
