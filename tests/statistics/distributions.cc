#include "apps/statistics/distributions.h"

#include "apps/statistics/references.h"
#include "tests/compare.h"

#include <cmath>

using namespace statistics;

namespace
{
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
      CHECK(std::fabs(t_probability_beyond(t, 1) - 2 / M_PI * std::atan(1 / t)) < 1e-14);
      CHECK(std::fabs(t_probability_beyond(-t, 2) - (1 - t / std::sqrt(2 + t * t))) < 1e-14);
      for (const double degrees : {3.0, 7.0, 35.0, 200.0})
        CHECK(std::fabs(f_probability_above(t * t, 1, degrees) - t_probability_beyond(t, degrees)) < 1e-14);
    }
}

TEST_CASE("distributions: limits are those of published tables", "[statistics]")
{
  compare(all_references(), "statistics: limits of F and t");
}

TEST_CASE("distributions: ten digits of F and t as another program gives them", "[statistics]")
{
  compare(all_references(), "statistics: probabilities of F and t");
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
  compare(all_references(), "statistics: half-normal quantiles");
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
