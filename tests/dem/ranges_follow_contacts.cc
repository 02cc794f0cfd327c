// Ranges of ranks follow the work that contacts bring: doc/theory/ranks.md, 3.
#include "clusters.h"
#include "dem/ranks/bricks.h"
#include "dem/specimen/specimen.h"
#include "memory_state.h"
#include "rank_threads.h"
#include "shared_bodies.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <numeric>
#include <vector>

using Eigen::Vector3d;
using namespace shared_bodies;

TEST_CASE("where contacts are born on one side, the other rank gets particles from there, and the bits stay",
          "[dem][ranks]")
{
  // Spheres that close in on each other, and as many above them that never touch.
  dem::Packing packing = cluster::cubic_lattice(8, 8, 16, 1e-3);
  for (Vector3d &centre : packing.centre)
    centre *= 1.2;
  const dem::Packing above   = cluster::cubic_lattice(8, 8, 16, 1e-3);
  const std::size_t  closing = packing.size();
  for (std::size_t i = 0; i < above.size(); ++i)
    {
      packing.centre.emplace_back(1.6 * above.centre[i] + Vector3d(0, 0, 0.05));
      packing.radius.push_back(above.radius[i]);
    }
  const auto make = [&] {
    dem::SpecimenParameters parameters = grains::falling();
    parameters.gravity.setZero();
    dem::Specimen body(packing, parameters, grains::rough());
    for (std::size_t i = 0; i < closing; ++i)
      body.set_velocity(i, -500 * packing.centre[i], Vector3d::Zero());
    return body;
  };
  constexpr std::int64_t steps = 220;
  omp_set_num_threads(1);
  dem::Specimen alone = make();
  alone.advance(steps);
  CHECK(alone.counts().contacts > 2 * closing);
  const MemoryState whole = MemoryState::of(alone);

  std::vector<char>                       same(2, 0);
  std::vector<std::vector<dem::RankWork>> early(2), late(2);
  rank_threads::run(2, [&](const std::shared_ptr<dem::Ranks> &ranks) {
    dem::Specimen body = make();
    body.share_among(ranks);
    body.advance(1);
    early[ranks->rank()] = body.shares();
    body.advance(steps - 1);
    late[ranks->rank()] = body.shares();
    same[ranks->rank()] = MemoryState::of(body) == whole;
  });
  CHECK(same == std::vector<char>(2, 1));
  const auto most = [](const std::vector<dem::RankWork> &of) {
    std::vector<double> work;
    for (const dem::RankWork &each : of)
      work.push_back(static_cast<double>(dem::updates_per_particle * each.particles + each.links + each.copies));
    return *std::max_element(work.begin(), work.end()) * static_cast<double>(work.size()) /
           std::accumulate(work.begin(), work.end(), 0.0);
  };
  CHECK(early[0][0].particles == early[0][1].particles);
  CHECK(late[0][0].particles != late[0][1].particles);
  CHECK(most(late[0]) < 1.1); // 1.33 with the ranges of the start
}
