#include "apps/statistics/distributions.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace statistics;

namespace
{
  constexpr double pi = 3.14159265358979323846;
}

TEST_CASE("distributions: F of two and of any degrees is its closed form", "[statistics]")
{
  for (const double degrees : {1.0, 2.0, 5.0, 35.0, 37.0, 120.0})
    for (const double ratio : {0.1, 1.0, 3.26742, 5.26794, 31.3257, 3004.5886})
      {
        INFO(ratio << " of 2 and " << degrees);
        const double closed = std::pow(1 + 2 * ratio / degrees, -degrees / 2);
        CHECK(std::fabs(f_probability_above(ratio, 2, degrees) / closed - 1) < 1e-10);
      }
}

TEST_CASE("distributions: t of one and of two degrees is its closed form, and F of one degree its square",
          "[statistics]")
{
  for (const double t : {0.25, 1.0, 2.5, 12.706, 63.657})
    {
      INFO(t);
      CHECK(std::fabs(t_probability_beyond(t, 1) - 2 / pi * std::atan(1 / t)) < 1e-14);
      CHECK(std::fabs(t_probability_beyond(-t, 2) - (1 - t / std::sqrt(2 + t * t))) < 1e-14);
      for (const double degrees : {3.0, 7.0, 35.0, 200.0})
        CHECK(std::fabs(f_probability_above(t * t, 1, degrees) - t_probability_beyond(t, degrees)) < 1e-14);
    }
}

TEST_CASE("distributions: limits are those of published tables", "[statistics]")
{
  // Five and one percent, to the digits that tables print.
  CHECK(f_limit(0.05, 2, 35) == Approx(3.26742).margin(5e-6));
  CHECK(f_limit(0.01, 2, 35) == Approx(5.26794).margin(5e-6));
  CHECK(f_limit(0.05, 2, 37) == Approx(3.252).margin(5e-4));
  CHECK(f_limit(0.05, 4, 20) == Approx(2.866).margin(5e-4));
  CHECK(f_limit(0.01, 10, 10) == Approx(4.849).margin(5e-4));
  CHECK(t_limit(0.025, 1) == Approx(12.706).margin(5e-4));
  CHECK(t_limit(0.025, 10) == Approx(2.228).margin(5e-4));
  CHECK(t_limit(0.005, 30) == Approx(2.750).margin(5e-4));
  CHECK(t_limit(0.05, 120) == Approx(1.658).margin(5e-4));
}

TEST_CASE("distributions: ten digits of F and t as another program gives them", "[statistics]")
{
  // scipy.stats 1.10, f.sf and t.sf.
  CHECK(f_probability_above(31.3257, 2, 35) == Approx(1.5915397161731136e-08).epsilon(1e-10));
  CHECK(f_probability_above(2.468, 3, 4) == Approx(0.2016273181585798).epsilon(1e-10));
  CHECK(f_probability_above(0.183, 20, 5) == Approx(0.9975046891585464).epsilon(1e-10));
  CHECK(f_probability_above(1.0, 7, 13) == Approx(0.4732108395323182).epsilon(1e-10));
  CHECK(f_probability_above(4.5, 12, 60) == Approx(4.053759606718197e-05).epsilon(1e-10));
  CHECK(f_probability_above(0.3, 1, 1) == Approx(0.6809942799600229).epsilon(1e-10));
  CHECK(t_probability_beyond(1.96, 3) == Approx(0.14485220856485362).epsilon(1e-10));
  CHECK(t_probability_beyond(15.3, 34) == Approx(8.224165312241963e-17).epsilon(1e-10));
  CHECK(t_probability_beyond(0.5, 57) == Approx(0.6189999472049581).epsilon(1e-10));
  CHECK(t_probability_beyond(4, 25) == Approx(0.0004954436705320874).epsilon(1e-10));
}

TEST_CASE("distributions: a limit is exceeded with the given probability", "[statistics]")
{
  for (const double probability : {0.1, 0.05, 0.01, 1e-6})
    for (const double degrees : {1.0, 4.0, 35.0})
      {
        CHECK(f_probability_above(f_limit(probability, 3, degrees), 3, degrees) == Approx(probability).epsilon(1e-10));
        CHECK(t_probability_beyond(t_limit(probability, degrees), degrees) == Approx(2 * probability).epsilon(1e-10));
      }
}

TEST_CASE("distributions: half-normal quantiles are those of published tables", "[statistics]")
{
  CHECK(half_normal_quantile(0.5) == Approx(0.6744897501960817).epsilon(1e-10));
  CHECK(half_normal_quantile(0.95) == Approx(1.959963984540054).epsilon(1e-10));
  CHECK_THROWS_AS(half_normal_quantile(1), std::invalid_argument);
}

TEST_CASE("distributions: without degrees of freedom there is no probability", "[statistics]")
{
  CHECK(std::isnan(f_probability_above(2, 2, 0)));
  CHECK(std::isnan(t_probability_beyond(2, 0)));
  CHECK(std::isnan(f_probability_above(std::nan(""), 2, 2)));
  CHECK(f_probability_above(INFINITY, 2, 5) == 0);
  CHECK_THROWS_AS(f_limit(0.05, 2, 0), std::invalid_argument);
  CHECK_THROWS_AS(t_limit(1.5, 3), std::invalid_argument);
}
