// Packings that ranks make together: doc/theory/packing.md, 1.
#include "dem/packing/compaction_on_ranks.h"
#include "dem/packing/frictional_assembly.h"
#include "dem/packing/sequential_placement.h"
#include "rank_threads.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{
  dem::CompactionParameters spheres(const std::size_t count, const double friction)
  {
    dem::CompactionParameters p;
    p.radius   = 1e-3;
    p.count    = count;
    p.friction = friction;
    return p;
  }

  /** All of a packing and how it was made. */
  std::vector<double> numbers_of(const dem::CompactionResult &made)
  {
    std::vector<double> all(made.edges.data(), made.edges.data() + 3);
    for (const Eigen::Vector3d &x : made.packing.centre)
      all.insert(all.end(), x.data(), x.data() + 3);
    all.insert(all.end(), made.packing.radius.begin(), made.packing.radius.end());
    all.insert(all.end(), {made.packing_fraction, made.mean_overlap, made.unbalanced_ratio, made.coordination,
                           static_cast<double>(made.steps), made.packing.periodic_cell ? 1.0 : 0.0});
    return all;
  }

  void check_on_ranks(const dem::CompactionParameters &p, const std::vector<std::size_t> &counts)
  {
    omp_set_num_threads(1);
    const std::vector<double> alone = numbers_of(dem::compact(p));
    for (const std::size_t count : counts)
      {
        std::vector<char> same(count, 0);
        rank_threads::run(count, [&](const std::shared_ptr<dem::Ranks> &ranks) {
          omp_set_num_threads(1);
          same[ranks->rank()] = numbers_of(dem::compact_on(ranks.get(), p)) == alone;
        });
        INFO(p.count << " spheres on " << count << " ranks");
        CHECK(same == std::vector<char>(count, 1));
      }
  }
} // namespace

TEST_CASE("a packing that ranks make together is that of one to the last bit", "[dem][ranks][packing]")
{
  check_on_ranks(spheres(1100, 0.5), {3});
}

TEST_CASE("so is one in a mould, one in a flat cell, and one of fewer bricks than ranks", "[dem][ranks][packing][slow]")
{
  dem::CompactionParameters moulded = spheres(900, 0.8);
  moulded.moulded                   = true;
  check_on_ranks(moulded, {2, 4});
  dem::CompactionParameters flat = spheres(1500, 0);
  flat.proportions               = {1, 3, 0.3};
  check_on_ranks(flat, {5});
  check_on_ranks(spheres(60, 1), {2, 3});
}

TEST_CASE("an assembly on ranks has the pressure, forces and overlaps of one at any moment", "[dem][ranks][packing]")
{
  // From a loose start, where no two spheres touch and one block of lines belongs to several ranks, through lists made anew.
  const dem::FrictionalAssemblyParameters material{0.5, 0.3, 0.4, 0.02};
  const std::size_t                       count = 1700;
  const dem::Packing                      start =
    dem::place_sequentially(count, 1.0, Eigen::Vector3d::Constant(2.4 * std::cbrt(static_cast<double>(count))), 5);
  const auto way = [&](dem::Ranks *const ranks) {
    dem::FrictionalAssembly assembly(start, material, ranks);
    std::vector<double>     row;
    for (int k = 0; k < 60; ++k)
      {
        assembly.advance(25, [](double) { return -1e-4; });
        const dem::AssemblyMeasures now = assembly.measures();
        row.insert(row.end(),
                   {now.pressure, now.unbalanced_ratio, static_cast<double>(now.contacts), assembly.mean_overlap()});
      }
    for (const Eigen::Vector3d &x : assembly.centres())
      row.insert(row.end(), x.data(), x.data() + 3);
    return row;
  };
  omp_set_num_threads(1);
  const std::vector<double> alone = way(nullptr);
  CHECK(alone[4 * 59 + 2] > 2000); // contacts at the end
  for (const std::size_t ranks_of_all : {2, 4, 9})
    {
      std::vector<char> same(ranks_of_all, 0);
      rank_threads::run(ranks_of_all, [&](const std::shared_ptr<dem::Ranks> &ranks) {
        omp_set_num_threads(ranks->rank() == 0 ? 2 : 1);
        same[ranks->rank()] = way(ranks.get()) == alone;
      });
      INFO(ranks_of_all << " ranks");
      CHECK(same == std::vector<char>(ranks_of_all, 1));
    }
}

TEST_CASE("a compaction on ranks is cancelled on all, and fails on all with the same words", "[dem][ranks][packing]")
{
  auto p       = spheres(600, 1);
  p.step_limit = 100;
  std::vector<std::string> words(3), after(3);
  rank_threads::run(3, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    try
      {
        dem::compact_on(ranks.get(), p);
      }
    catch (const dem::CompactionFailed &error)
      {
        words[ranks->rank()] = error.what();
      }
    try
      {
        dem::compact_on(ranks.get(), p, [](const dem::CompactionProgress &now) { return now.steps < 60; });
      }
    catch (const dem::CompactionCancelled &error)
      {
        after[ranks->rank()] = error.what();
      }
  });
  CHECK_THAT(words[0], Catch::Contains("step limit = 100"));
  CHECK(words == std::vector<std::string>(3, words[0]));
  CHECK_THAT(after[0], Catch::Contains("cancelled"));
  CHECK(after == std::vector<std::string>(3, after[0]));
}
