// Bricks, shares, cut links and ghosts, counted once more link by link; what a step over ranks is expected to cost.
#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"
#include "dem/packing/lattice.h"
#include "dem/ranks/exchange_cost.h"
#include "dem/ranks/shares.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

namespace
{
  struct Linked
  {
    std::size_t   particles = 0;
    dem::LinkEnds links;
  };

  /** Face-centred cubic lattice, its particles along the curve, each linked to those that it touches. */
  Linked lattice(const std::array<int, 3> &cells, const bool periodic)
  {
    const dem::Packing              packing = dem::make_lattice(dem::Lattice::face_centred_cubic, 0.5, cells);
    const std::vector<std::int32_t> order   = dem::hilbert_order(packing.centre);
    std::vector<Eigen::Vector3d>    centre;
    for (const std::int32_t i : order)
      centre.push_back(packing.centre[static_cast<std::size_t>(i)]);
    Linked linked;
    linked.particles = centre.size();
    for (const auto &pair :
         dem::find_pairs(centre, packing.radius, 1.1, 0, periodic ? packing.periodic_cell : std::nullopt))
      {
        linked.links.first.push_back(pair.first);
        linked.links.second.push_back(pair.second);
      }
    return linked;
  }

  std::size_t rank_of(const std::vector<dem::RankShare> &shares, const std::int32_t particle)
  {
    std::size_t found = shares.size(), times = 0;
    for (std::size_t r = 0; r < shares.size(); ++r)
      if (static_cast<std::size_t>(particle) >= shares[r].first_particle &&
          static_cast<std::size_t>(particle) < shares[r].end_particle)
        {
          found = r;
          ++times;
        }
    REQUIRE(times == 1);
    return found;
  }

  std::vector<std::int32_t> sorted(const std::set<std::int32_t> &set) { return {set.begin(), set.end()}; }
} // namespace

TEST_CASE("every link is owned by one rank, and every cut link is computed on both sides with the ghosts that it needs",
          "[ranks]")
{
  for (const bool periodic : {false, true})
    {
      const Linked                    body     = lattice({9, 8, 7}, periodic);
      const auto                      bricks   = dem::particle_blocks(body.particles);
      const std::vector<std::int64_t> of_brick = dem::work_of_bricks(body.particles, body.links);
      for (const std::size_t ranks : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{8}, bricks + 5})
        {
          CAPTURE(periodic, ranks);
          const auto shares = dem::share_out(body.particles, body.links, ranks);
          REQUIRE(shares.size() == ranks);
          std::vector<std::size_t>               owned(ranks, 0);
          std::vector<std::vector<std::int32_t>> copied(ranks);
          std::vector<std::set<std::int32_t>>    ghosts(ranks);
          for (std::size_t l = 0; l < body.links.size(); ++l)
            {
              const std::int32_t J = body.links.first[l], K = body.links.second[l];
              const std::size_t  first = rank_of(shares, J), second = rank_of(shares, K);
              ++owned[first];
              if (first == second)
                continue;
              copied[second].push_back(static_cast<std::int32_t>(l));
              ghosts[first].insert(K);
              ghosts[second].insert(J);
            }
          std::int64_t work = 0, copies = 0;
          std::size_t  sent = 0, received = 0;
          for (std::size_t r = 0; r < ranks; ++r)
            {
              CHECK(shares[r].owned == owned[r]);
              CHECK(shares[r].copied == copied[r]);
              CHECK(shares[r].ghosts == sorted(ghosts[r]));
              CHECK(shares[r].work ==
                    static_cast<std::int64_t>(3 * shares[r].particles() + owned[r] + copied[r].size()));
              work += shares[r].work;
              copies += static_cast<std::int64_t>(copied[r].size());
              sent += shares[r].sent();
              received += shares[r].received();
              for (const dem::RankNeighbour &n : shares[r].neighbours)
                {
                  const auto from = std::count_if(shares[r].ghosts.begin(), shares[r].ghosts.end(),
                                                  [&](const auto g) { return rank_of(shares, g) == n.rank; });
                  CHECK(static_cast<std::size_t>(from) == n.received);
                }
            }
          CHECK(sent == received);
          CHECK(work == std::accumulate(of_brick.begin(), of_brick.end(), std::int64_t{0}) + copies);
          CHECK(shares.back().end_particle == body.particles);
          CHECK((ranks > 1) == (copies > 0));
        }
    }
}

TEST_CASE("ranges of bricks are off the mean by no more than one brick's work", "[ranks]")
{
  std::vector<std::int64_t> work;
  for (std::int64_t b = 0; b < 300; ++b)
    work.push_back(700 + 211 * b % 997 + (b == 120 ? 4000 : 0));
  const double all      = static_cast<double>(std::accumulate(work.begin(), work.end(), std::int64_t{0}));
  const double heaviest = static_cast<double>(*std::max_element(work.begin(), work.end()));
  for (const std::size_t ranks : {1, 2, 3, 8, 27, 299, 300, 301, 1000})
    {
      const std::vector<std::size_t> first = dem::even_ranges(work, ranks);
      REQUIRE(first.size() == ranks + 1);
      CHECK(first.front() == 0);
      CHECK(first.back() == work.size());
      for (std::size_t r = 0; r < ranks; ++r)
        {
          REQUIRE(first[r] <= first[r + 1]);
          double part = 0;
          for (std::size_t b = first[r]; b < first[r + 1]; ++b)
            part += static_cast<double>(work[b]);
          CHECK(std::abs(part - all / static_cast<double>(ranks)) <= heaviest);
        }
    }
  CHECK_THROWS_AS(dem::even_ranges(work, 0), std::invalid_argument);
}

TEST_CASE("the largest of the shares with their copies is near the mean", "[ranks]")
{
  const Linked body     = lattice({16, 16, 16}, false);
  const auto   bricks   = dem::work_of_bricks(body.particles, body.links);
  const double heaviest = static_cast<double>(*std::max_element(bricks.begin(), bricks.end()));
  for (const std::size_t ranks : {2, 3, 8})
    {
      const auto shares = dem::share_out(body.particles, body.links, ranks);
      double     all = 0, most = 0;
      for (const dem::RankShare &share : shares)
        {
          all += static_cast<double>(share.work);
          most = std::max(most, static_cast<double>(share.work));
        }
      CAPTURE(ranks, most, all);
      CHECK(most - all / static_cast<double>(ranks) <=
            1.5 * heaviest); // one of the range, and copies that the last evening moved
    }
}

TEST_CASE("shares refuse links that end in no particle", "[ranks]")
{
  CHECK_THROWS_AS(dem::share_out(3, {{0, 1}, {1, 3}}, 2), std::invalid_argument);
  CHECK_THROWS_AS(dem::share_out(3, {{0, -1}, {1, 2}}, 2), std::invalid_argument);
  CHECK_THROWS_AS(dem::share_out(3, {{0, 1}, {1}}, 2), std::invalid_argument);
}

TEST_CASE("a step over ranks costs what its slowest rank does and exchanges, and what all hear from all", "[ranks]")
{
  // Three bricks in a row on three ranks, joined by one link each: the middle one has two neighbours.
  dem::LinkEnds links{{255, 511}, {256, 512}};
  const auto    shares = dem::share_out(3 * dem::particles_per_brick, links, 3);
  REQUIRE(shares[1].neighbours.size() == 2);
  REQUIRE(shares[1].work == 3 * 256 + 1 + 1);
  const dem::Network network{1e-6, 1e9};
  const double       tau = 1e-8, exchange = 2e-6 + 2 * 96 / 1e9;
  CHECK(dem::seconds_of_exchange(shares[1], network) == Approx(exchange));
  const double step = exchange + tau * 770 + 3 * 64 / 1e9 + 3 * 2 * 1e-6;
  CHECK(dem::seconds_of_step(shares, tau, network) == Approx(step));
  CHECK(dem::parallel_efficiency(shares, tau, network) == Approx(tau * (3 * 3 * 256 + 2) / (3 * step)));

  CHECK(dem::parallel_efficiency(dem::share_out(4 * dem::particles_per_brick, {{511}, {512}}, 1), tau, network) ==
        Approx(1.0));
}
