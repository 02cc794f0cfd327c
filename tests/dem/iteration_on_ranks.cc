// Linear networks solved by several ranks: the same bits as by one.
#include "dem/linear/linear_solver.h"
#include "dem/linear/rigid_groups.h"
#include "tests/dem/homogenisation_fixture.h"
#include "tests/dem/rank_threads.h"

#include <catch2/catch.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

using namespace homogenisation_fixture;

namespace
{
  /** A linear problem: a cell under macroscopic strains, some of it held, loads on the rest. */
  struct Problem
  {
    dem::ElasticNetwork           network;
    std::vector<dem::HeldMotions> held;
    double                        load   = 0;
    dem::SolverMethod             method = dem::SolverMethod::iterative;
  };

  struct Solution
  {
    dem::Fields       x;
    dem::SolverReport report;
  };

  Solution solve(const Problem &problem, dem::Ranks *const ranks)
  {
    const dem::StiffnessOperator stiffness(problem.network, problem.held);
    Solution                     found{dem::Fields(stiffness.particles() * dem::motions * dem::load_lanes, 0.0), {}};
    dem::Fields                  loads(found.x);
    dem::LaneStrains             strain;
    for (int lane = 0; lane < dem::load_lanes; ++lane)
      strain[lane] = lane < 6 ? base::Vector6(base::Vector6::Unit(lane)) : base::Vector6(base::Vector6::Zero());
    for (std::size_t i = 0; i < stiffness.particles(); ++i)
      for (int c = 0; c < dem::motions; ++c)
        for (int lane = 0; lane < dem::first_probe && !stiffness.is_held(i, c); ++lane)
          loads[(dem::motions * i + c) * dem::load_lanes + lane] =
            problem.load * std::sin(1.0 + 7.0 * i + 3.0 * c + lane);
    dem::SolverParameters parameters;
    parameters.method = problem.method;
    parameters.ranks  = ranks;
    found.report      = dem::solve_linear(stiffness, loads, found.x, strain, problem.held.empty(), parameters);
    return found;
  }

  bool same_bits(const dem::Fields &a, const dem::Fields &b)
  {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  }

  Solution check_on_ranks(const Problem                  &problem,
                          const std::vector<std::size_t> &numbers = {1, 2, 3, 5}) // three bricks
  {
    omp_set_num_threads(1);
    const Solution alone = solve(problem, nullptr);
    REQUIRE(alone.report.converged);
    for (const std::size_t ranks : numbers)
      {
        std::vector<std::string> wrong(ranks);
        rank_threads::run(ranks, [&](const std::shared_ptr<dem::Ranks> &team) {
          omp_set_num_threads(team->rank() == 0 ? 2 : 1);
          const Solution shared = solve(problem, team.get());
          std::string   &words  = wrong[team->rank()];
          if (!same_bits(shared.x, alone.x))
            words += "motions; ";
          if (shared.report.iterations != alone.report.iterations || shared.report.residual != alone.report.residual)
            words += "iterations; ";
          if (shared.report.method != alone.report.method)
            words += "method; ";
          if (dem::floaters(shared.report.mechanisms) != dem::floaters(alone.report.mechanisms))
            words += "mechanisms; ";
        });
        INFO(ranks << " ranks");
        CHECK(wrong == std::vector<std::string>(ranks));
      }
    return alone;
  }

  /** Links so unlike each other that the iteration would take long: the automatic method goes over to a factor. */
  Problem hard_problem()
  {
    Problem problem{dem::make_network(random_spheres(600, 5), links(1.5, 0.2)), {}, 0, dem::SolverMethod::automatic};
    for (std::size_t l = 0; l < problem.network.links.size(); ++l)
      problem.network.links[l].stiffness *= std::pow(10.0, static_cast<double>(l % 7));
    return problem;
  }

  dem::ElasticNetwork random_network(const double shear_ratio)
  {
    return dem::make_network(random_spheres(700, 5), links(1.6, shear_ratio));
  }
} // namespace

TEST_CASE("conjugate gradients on ranks: every number has the bits of one", "[dem][statics][ranks]")
{
  SECTION("a periodic cell") { check_on_ranks({random_network(0.2), {}, 0}); }

  SECTION("links with moments, particles held, loads")
  {
    Problem problem{random_network(0.2), std::vector<dem::HeldMotions>(700, 0), 1e-3};
    for (dem::ElasticLink &link : problem.network.links)
      link.turning = 0.1 * link.stiffness;
    for (std::size_t i = 0; i < problem.held.size(); i += 40)
      problem.held[i] = i % 3 == 0 ? 0x3f : 0x05;
    check_on_ranks(problem);
  }

  SECTION("particles without links, named as mechanisms")
  {
    Problem    problem{random_network(0.2), {}, 0};
    auto      &links = problem.network.links;
    const auto ends  = [](const dem::ElasticLink &l) { return l.first % 100 == 7 || l.second % 100 == 7; };
    links.erase(std::remove_if(links.begin(), links.end(), ends), links.end());
    CHECK(check_on_ranks(problem).report.mechanisms.size() == 7);
  }
}

TEST_CASE("conjugate gradients on ranks: rigid motions of groups have the bits of one", "[dem][statics][ranks][slow]")
{
  Problem problem{dem::make_network(random_spheres(4500, 5), links(1.6, 0.2)), {}, 0};
  REQUIRE(problem.network.particles() > dem::RigidGroups::fewest_particles);
  const auto ends = [](const dem::ElasticLink &l) { return l.first % 500 == 7 || l.second % 500 == 7; };
  auto      &all  = problem.network.links;
  all.erase(std::remove_if(all.begin(), all.end(), ends), all.end());
  const Solution alone = check_on_ranks(problem, {2, 3}); // eighteen bricks
  CHECK(alone.report.mechanisms.size() == 9);
  CHECK(alone.report.iterations < 100);
}

TEST_CASE("conjugate gradients on ranks: that leave off for a factor do so alike", "[dem][statics][ranks]")
{
  const Solution alone = check_on_ranks(hard_problem());
  CHECK(alone.report.method == dem::SolverMethod::direct);
}

TEST_CASE("direct solutions by several threads of a process at once have the bits of one", "[dem][statics]")
{
  Problem problem = hard_problem();
  problem.method  = dem::SolverMethod::direct;
  omp_set_num_threads(1);
  const Solution           alone = solve(problem, nullptr);
  constexpr int            times = 8;
  std::vector<char>        same(3 * times, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      omp_set_num_threads(1);
      for (int k = 0; k < times; ++k)
        same[t * times + k] = same_bits(solve(problem, nullptr).x, alone.x);
    });
  for (std::thread &thread : threads)
    thread.join();
  CHECK(std::count(same.begin(), same.end(), 1) == 3 * times);
}
