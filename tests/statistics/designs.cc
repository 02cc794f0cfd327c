#include "apps/statistics/array_check.h"
#include "apps/statistics/galois_field.h"
#include "apps/statistics/level_designs.h"
#include "apps/statistics/orthogonal_array.h"
#include "apps/statistics/space_filling.h"
#include "apps/statistics/surface_designs.h"
#include "base/errors.h"
#include "tests/statistics/published_table.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>
#include <set>

using namespace statistics;

namespace
{
  std::vector<Factor> columns_of(const Eigen::MatrixXi &array)
  {
    std::vector<Factor> factors;
    for (Eigen::Index column = 0; column < array.cols(); ++column)
      factors.push_back({"column " + std::to_string(column + 1), array.col(column).cast<double>()});
    return factors;
  }

  std::vector<int> row_of(const Eigen::MatrixXi &array, const int row)
  {
    const Eigen::RowVectorXi values = array.row(row);
    return {values.begin(), values.end()};
  }

  bool repeats_a_run(const Eigen::MatrixXd &design)
  {
    std::set<std::vector<double>> seen;
    for (const auto &row : design.rowwise())
      {
        const Eigen::RowVectorXd values = row;
        if (!seen.insert(std::vector<double>(values.begin(), values.end())).second)
          return true;
      }
    return false;
  }
} // namespace

TEST_CASE("fields: addition and multiplication obey their laws, and all but zero can be inverted", "[statistics]")
{
  for (const int order : {2, 3, 4, 5, 7, 8, 9})
    {
      const GaloisField field(order);
      INFO("order " << order);
      for (int a = 0; a < order; ++a)
        {
          CHECK(field.add(a, 0) == a);
          CHECK(field.multiply(a, 1) == a);
          std::set<int> sums, products;
          for (int b = 0; b < order; ++b)
            {
              sums.insert(field.add(a, b));
              products.insert(field.multiply(a, b));
              for (int c = 0; c < order; ++c)
                {
                  CHECK(field.multiply(a, field.add(b, c)) == field.add(field.multiply(a, b), field.multiply(a, c)));
                  CHECK(field.multiply(a, field.multiply(b, c)) == field.multiply(field.multiply(a, b), c));
                }
            }
          CHECK(sums.size() == std::size_t(order));
          CHECK(products.size() == (a == 0 ? 1 : std::size_t(order)));
        }
    }
  const GaloisField four(4);
  CHECK(four.multiply(2, 2) == 3);
  CHECK(four.multiply(2, 3) == 1);
  CHECK(four.add(2, 3) == 1);
  CHECK_THROWS_WITH(GaloisField(6), Catch::Contains("6 levels"));
}

TEST_CASE("orthogonal arrays: L27 has the rows of the textbook's construction", "[statistics]")
{
  const Eigen::MatrixXi array = orthogonal_array(3, 3);
  REQUIRE(array.rows() == 27);
  REQUIRE(array.cols() == 13);
  CHECK(row_of(array, 1) == std::vector<int>{1, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2});
  CHECK(row_of(array, 13) == std::vector<int>{1, 1, 2, 0, 1, 2, 0, 2, 0, 1, 0, 1, 2});
  CHECK(row_of(array, 26) == std::vector<int>{2, 2, 1, 0, 2, 1, 0, 1, 0, 2, 0, 2, 1});
}

TEST_CASE("orthogonal arrays: every pair of columns has every pair of levels as often", "[statistics]")
{
  const auto [levels, exponent, columns] = GENERATE(table<int, int, int>({{2, 3, 7},
                                                                          {3, 2, 4},
                                                                          {3, 3, 13},
                                                                          {3, 4, 40},
                                                                          {3, 5, 121},
                                                                          {4, 3, 21},
                                                                          {5, 2, 6},
                                                                          {7, 2, 8},
                                                                          {8, 2, 9},
                                                                          {9, 2, 10}}));
  const Eigen::MatrixXi array            = orthogonal_array(levels, exponent);
  CHECK(array.cols() == columns);
  const ArrayCheck check = check_array(columns_of(array));
  CHECK(check.balanced);
  CHECK(check.proportional);
  CHECK(check.duplicates.empty());
  CHECK(check.rank == check.wanted);
  CHECK(check.wanted == array.rows()); // saturated: all runs are spent on main effects
}

TEST_CASE("orthogonal arrays: four levels collapsed to three stay proportional, but are not balanced", "[statistics]")
{
  std::vector<int> columns(21);
  std::iota(columns.begin(), columns.end(), 0);
  const ArrayCheck check = check_array(columns_of(collapsed(orthogonal_array(4, 3), columns)));
  CHECK_FALSE(check.balanced);
  CHECK(check.proportional);
  CHECK_FALSE(check.worst_pair);
  for (const Levels &levels : check.levels)
    CHECK(levels.counts == std::vector<int>{32, 16, 16});
  CHECK_THROWS_AS(collapsed(orthogonal_array(4, 3), {21}), std::invalid_argument);
  CHECK_THROWS_AS(orthogonal_array(3, 1), base::InputError);
  CHECK_THROWS_AS(orthogonal_array(9, 5), base::InputError);
}

TEST_CASE("array check: the published design of concrete is a collapsed array with one run copied", "[statistics]")
{
  const PublishedTable table("concrete_orthogonal.csv");
  const ArrayCheck     check = check_array(table.factors(orthogonal_columns));
  REQUIRE(check.levels.size() == 14);
  for (const Levels &levels : check.levels)
    CHECK(levels.counts == std::vector<int>{32, 16, 16});
  CHECK_FALSE(check.balanced);
  CHECK(check.proportional);
  CHECK(check.rank == 29);
  CHECK(check.wanted == 29);
  REQUIRE(check.duplicates.size() == 1);
  CHECK(table.column("run")[check.duplicates[0].first] == 37);
  CHECK(table.column("run")[check.duplicates[0].second] == 35);
}

TEST_CASE("array check: a pair out of proportion and a lost degree are found", "[statistics]")
{
  std::vector<Factor> factors = columns_of(orthogonal_array(3, 3));
  factors.resize(3);
  factors[2].values[5]   = factors[2].values[5] == 0 ? 1 : 0;
  const ArrayCheck moved = check_array(factors);
  CHECK_FALSE(moved.proportional);
  CHECK_FALSE(moved.balanced);
  REQUIRE(moved.worst_pair);
  CHECK(moved.worst_pair->second == 2);
  factors[2].values      = factors[0].values;
  const ArrayCheck twice = check_array(factors);
  CHECK(twice.wanted == 7);
  CHECK(twice.rank == 5);
  CHECK_THROWS_AS(check_array({}), base::InputError);
}

TEST_CASE("designs: one at a time changes one factor of the reference in each run", "[statistics]")
{
  const Eigen::MatrixXi design = one_at_a_time({3, 2, 6}, {1, 0, 3});
  REQUIRE(design.rows() == 1 + 2 + 1 + 5);
  CHECK(row_of(design, 0) == std::vector<int>{1, 0, 3});
  for (int run = 1; run < design.rows(); ++run)
    CHECK((design.row(run).array() != design.row(0).array()).count() == 1);
  CHECK_FALSE(repeats_a_run(design.cast<double>()));
  CHECK_THROWS_WITH(one_at_a_time({3, 2}, {1, 2}), Catch::Contains("factor 2"));
}

TEST_CASE("designs: a full factorial has every combination once", "[statistics]")
{
  const Eigen::MatrixXi design = full_factorial({3, 2, 4});
  REQUIRE(design.rows() == 24);
  CHECK_FALSE(repeats_a_run(design.cast<double>()));
  CHECK(check_array(columns_of(design)).balanced);
  CHECK(row_of(design, 1) == std::vector<int>{0, 0, 1});
  CHECK_THROWS_WITH(full_factorial({3, 0}), Catch::Contains("factor 2 has no level"));
  CHECK_THROWS_AS(full_factorial(std::vector<int>(21, 2)), base::InputError);
}

TEST_CASE("designs: the central composite one is the published design of strength", "[statistics]")
{
  CHECK(rotatable_distance(2) == Approx(1.41421).margin(5e-6));
  CHECK(rotatable_distance(5) == Approx(2.37841).margin(5e-6));
  const Eigen::MatrixXd design = central_composite(2, rotatable_distance(2), 5);
  REQUIRE(design.rows() == 13);
  std::multiset<std::vector<long>> ours, published;
  for (const auto &run : design.rowwise())
    ours.insert({std::lround(1e3 * (20 + 10 * run[0])), std::lround(1e3 * (20 + 10 * run[1]))});
  const PublishedTable table("concrete_strength.csv");
  for (int run = 0; run < 13; ++run)
    published.insert(
      {std::lround(1e3 * table.column("sigc_MPa")[run]), std::lround(1e3 * table.column("tauc_MPa")[run])});
  CHECK(ours == published);
  CHECK(central_composite(4, 2, 6).rows() == 16 + 8 + 6);
  CHECK_THROWS_AS(central_composite(1, 1, 1), base::InputError);
  CHECK_THROWS_AS(central_composite(3, 1, -1), base::InputError);
}

TEST_CASE("designs: Box and Behnken's is the published design of the modulus", "[statistics]")
{
  const Eigen::MatrixXd design = box_behnken(5, 6);
  REQUIRE(design.rows() == 46);
  const PublishedTable               table("concrete_modulus.csv");
  const std::vector<Factor>          factors = table.factors({"Ec_GPa", "kn_ks", "mu", "Ecj_GPa", "kn_ks_j"});
  std::multiset<std::vector<double>> ours, published;
  for (int run = 0; run < 46; ++run)
    {
      std::vector<double> own, other;
      for (int factor = 0; factor < 5; ++factor)
        {
          const Eigen::VectorXd &values = factors[factor].values;
          const double           centre = (values.minCoeff() + values.maxCoeff()) / 2;
          own.push_back(centre + design(run, factor) * (values.maxCoeff() - centre));
          other.push_back(values[run]);
        }
      ours.insert(own);
      published.insert(other);
    }
  CHECK(ours == published);
}

TEST_CASE("designs: Box and Behnken's of three to seven factors have the runs of the paper and equal use of factors",
          "[statistics]")
{
  const auto [factors, runs]   = GENERATE(table<int, int>({{3, 12}, {4, 24}, {5, 40}, {6, 48}, {7, 56}}));
  const Eigen::MatrixXd design = box_behnken(factors, 0);
  CHECK(design.rows() == runs);
  CHECK_FALSE(repeats_a_run(design));
  CHECK(design.colwise().sum().isZero());
  const Eigen::MatrixXd moments = design.transpose() * design;
  CHECK(moments.isApprox(moments(0, 0) * Eigen::MatrixXd::Identity(factors, factors)));
  CHECK_THROWS_AS(box_behnken(8, 0), base::InputError);
}

TEST_CASE("designs: a Latin hypercube has one run in each slice, by its seed alone", "[statistics]")
{
  const Eigen::MatrixXd points = latin_hypercube(40, 6, 7);
  for (const auto &column : points.colwise())
    {
      std::set<int> slices;
      for (const double value : column)
        slices.insert(static_cast<int>(value * 40));
      CHECK(slices.size() == 40);
    }
  CHECK(points == latin_hypercube(40, 6, 7));
  CHECK(points != latin_hypercube(40, 6, 8));
  CHECK_THROWS_AS(latin_hypercube(0, 6, 7), base::InputError);
}

TEST_CASE("designs: Sobol's sequence begins as published and fills every dyadic slice", "[statistics]")
{
  const Eigen::MatrixXd points = sobol_points(255, 5);
  CHECK(points.row(0).isConstant(0.5));
  CHECK(points(1, 0) == 0.75);
  CHECK(points(1, 1) == 0.25);
  CHECK(points(2, 0) == 0.25);
  CHECK(points(2, 1) == 0.75);
  for (const auto &column : points.colwise()) // with the origin, which is left out, one point in each of 256 slices
    {
      std::set<int> slices = {0};
      for (const double value : column)
        slices.insert(static_cast<int>(value * 256));
      CHECK(slices.size() == 256);
    }
  CHECK_THROWS_AS(sobol_points(10, 3668), base::InputError);
}
