#include "base/errors.h"
#include "dem/core/uniform_random.h"
#include "dem/neighbours/cell_list.h"
#include "dem/packing/sequential_placement.h"

#include <catch2/catch.hpp>

#include <cmath>

TEST_CASE("random numbers are the upper 53 bits of the standard's 64-bit Mersenne twister", "[dem][packing]")
{
  // The C++ standard fixes the 10000th number of a default-constructed (seed 5489) mt19937_64: 9981545732273789042.
  dem::UniformRandom random(5489);
  double             value = 0;
  for (int i = 0; i < 10000; ++i)
    value = random();
  REQUIRE(value == static_cast<double>(9981545732273789042ULL >> 11) / 9007199254740992.0);
}

TEST_CASE("randomly placed spheres do not overlap, not even across the cell", "[dem][packing]")
{
  for (const double spacing : {2.4, 3.0, 6.0})
    for (const std::size_t count : {1, 5, 27, 1000})
      {
        const double       edge    = 0.01 * spacing * std::cbrt(static_cast<double>(count));
        const dem::Packing packing = dem::place_sequentially(count, 0.01, Eigen::Vector3d::Constant(edge), 3);
        REQUIRE(packing.size() == count);
        REQUIRE(dem::find_pairs(packing.centre, packing.radius, 1.0, 0.0, packing.periodic_cell).empty());
      }
}

TEST_CASE("randomly placed spheres fill a cell of three different edges without overlap", "[dem][packing]")
{
  const Eigen::Vector3d edges(0.1, 0.03, 0.4);
  const dem::Packing    packing = dem::place_sequentially(600, 5e-3, edges, 5);
  REQUIRE(*packing.periodic_cell == edges);
  REQUIRE(dem::find_pairs(packing.centre, packing.radius, 1.0, 0.0, packing.periodic_cell).empty());
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (const auto &x : packing.centre)
    largest = largest.cwiseMax(x);
  for (int d = 0; d < 3; ++d)
    REQUIRE(largest[d] == Approx(edges[d]).epsilon(0.05));
}

TEST_CASE("random places are uniform over the cell", "[dem][packing]")
{
  // 4000 spheres so small that they hardly exclude each other, counted in 8 slices along each axis: chi squared of 7
  // degrees of freedom exceeds 24.3 once in a thousand draws; the seed is fixed.
  const dem::Packing packing = dem::place_sequentially(4000, 0.001, Eigen::Vector3d::Ones(), 11);
  for (int d = 0; d < 3; ++d)
    {
      double count[8] = {};
      for (const auto &x : packing.centre)
        count[static_cast<int>(8 * x[d])] += 1;
      double chi_squared = 0;
      for (const double c : count)
        chi_squared += (c - 500) * (c - 500) / 500;
      REQUIRE(chi_squared < 24.3);
    }
}

TEST_CASE("a cell without room is refused", "[dem][packing]")
{
  using Catch::Contains;
  REQUIRE_THROWS_WITH(dem::place_sequentially(1, 1.0, Eigen::Vector3d(1.9, 9, 9), 1), Contains("own image"));
  // 0.45 of the volume: beyond what random placement can ever fill.
  REQUIRE_THROWS_WITH(dem::place_sequentially(100, 1.0, Eigen::Vector3d::Constant(std::cbrt(100 * 4.19 / 0.45)), 1),
                      Contains("no free place"));
  REQUIRE_THROWS_AS(dem::place_sequentially(100, 1.0, Eigen::Vector3d::Constant(5.0), 1), base::InputError);
}
