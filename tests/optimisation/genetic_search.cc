#include "apps/optimisation/genetic_search.h"

#include "base/errors.h"

#include <catch2/catch.hpp>

#include <cmath>

using optimisation::genetic_minimum;
using optimisation::GeneticOptions;

namespace
{
  constexpr int variables = 7;

  /** From the unit cube to (-5.12, 5.12), the minimum moved away from the middle. */
  Eigen::ArrayXd from_minimum(const Eigen::VectorXd &cube) { return 10.24 * cube.array() - 5.12 - 1.3; }

  double sphere(const Eigen::VectorXd &cube) { return from_minimum(cube).square().sum(); }

  double rastrigin(const Eigen::VectorXd &cube)
  {
    const Eigen::ArrayXd x = from_minimum(cube);
    return 10.0 * variables + (x.square() - 10 * (2 * M_PI * x).cos()).sum();
  }
} // namespace

TEST_CASE("genetic search: the minimum of a sphere of seven variables is found to 1e-8", "[optimisation]")
{
  for (const int seed : {1, 2, 3})
    CHECK(sphere(genetic_minimum(sphere, variables, {300, 300, std::uint64_t(seed)})) < 1e-8);
}

TEST_CASE("genetic search: the minimum of Rastrigin's function of seven variables is found from four starts of five",
          "[optimisation]")
{
  int found = 0;
  for (int start = 0; start < 5; ++start)
    found += rastrigin(genetic_minimum(rastrigin, variables, {300, 300, std::uint64_t(1000 * start + 1)})) < 1;
  CHECK(found >= 4);
}

TEST_CASE("genetic search: a minimum on the boundary is found on it", "[optimisation]")
{
  const auto slope = [](const Eigen::VectorXd &cube) { return cube[0] - 2 * cube[1] + std::fabs(cube[2] - 0.3); };
  const Eigen::VectorXd found = genetic_minimum(slope, 3, {40, 100, 1});
  CHECK(found[0] == Approx(0).margin(1e-9));
  CHECK(found[1] == Approx(1).margin(1e-9));
  CHECK(found[2] == Approx(0.3).margin(1e-7));
}

TEST_CASE("genetic search: the same seed gives the same bits, another seed another path", "[optimisation]")
{
  const GeneticOptions  few{20, 7, 5};
  const Eigen::VectorXd first = genetic_minimum(rastrigin, variables, few);
  CHECK(genetic_minimum(rastrigin, variables, few) == first);
  CHECK(genetic_minimum(rastrigin, variables, {20, 7, 6}) != first);
}

TEST_CASE("genetic search: what it cannot search with is refused", "[optimisation]")
{
  CHECK_THROWS_AS(genetic_minimum(sphere, 0, {}), base::InputError);
  CHECK_THROWS_AS(genetic_minimum(sphere, variables, {31, 10, 1}), base::InputError);
  CHECK_THROWS_AS(genetic_minimum(sphere, variables, {2, 10, 1}), base::InputError);
}
