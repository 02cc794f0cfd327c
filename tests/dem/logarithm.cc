#include "dem/core/logarithm.h"

#include "dem/core/uniform_random.h"
#include "dem/laws/rate_equation.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace
{
  /** Distance to ln x in units of the last place of ln x; the reference is the 64-bit mantissa of long double. */
  double logarithm_error_in_ulp(const double x)
  {
    const long double exact = logl(x);
    const double      near  = static_cast<double>(fabsl(exact));
    const long double ulp   = std::nextafter(near, 1e300) - static_cast<long double>(near);
    return static_cast<double>(fabsl(dem::logarithm(x) - exact) / ulp);
  }

  /** The same of eight numbers as of each: @return how many differ */
  template <typename Function>
  int differing_lanes(const double (&x)[dem::pack_size], const double (&y)[dem::pack_size], Function &&f)
  {
    alignas(64) double first[dem::pack_size], second[dem::pack_size], found[dem::pack_size];
    std::copy_n(x, dem::pack_size, first);
    std::copy_n(y, dem::pack_size, second);
    dem::store(f(dem::load(first), dem::load(second)), found);
    int different = 0;
    for (int lane = 0; lane < dem::pack_size; ++lane)
      different += found[lane] != f(x[lane], y[lane]);
    return different;
  }
} // namespace

TEST_CASE("logarithm is within four units in the last place, near one too", "[dem]")
{
  double             largest = 0;
  dem::UniformRandom random(1);
  for (int i = 0; i < 100000; ++i)
    {
      largest = std::max(largest, logarithm_error_in_ulp(std::pow(10.0, -300 + 600 * random())));
      largest = std::max(largest, logarithm_error_in_ulp(1 + std::pow(10.0, -15 + 15 * random())));
      largest = std::max(largest, logarithm_error_in_ulp(1 - 0.9 * std::pow(10.0, -15 + 15 * random())));
    }
  for (int k = -1000; k < 1000; ++k) // around the jumps of the reduction
    for (const double off : {1 - 1e-12, 1.0, 1 + 1e-12})
      largest = std::max(largest, logarithm_error_in_ulp(std::ldexp(std::sqrt(2.0) * off, k)));
  CHECK(largest <= 4.0);
  CHECK(dem::logarithm(1.0) == 0.0);
}

TEST_CASE("rate equation has its published roots, and those of closed forms for any factor", "[dem][laws]")
{
  CHECK(dem::solve_rate_equation(std::log(1.0), 0.5) == Approx(-0.962423650119).epsilon(1e-12));
  CHECK(dem::solve_rate_equation(std::log(0.1), 0.1) == Approx(-0.104209309531).epsilon(1e-11));
  for (int power = -30; power <= 30; ++power)
    {
      const double c = std::pow(10.0, 0.5 * power);
      INFO("c = " << c);
      // M = 1: e^beta = 1/(1 + c). M = 1/2: a quadratic equation for e^(beta/2), without cancellation for large c.
      CHECK(dem::solve_rate_equation(std::log(c), 1.0) == Approx(-std::log1p(c)).epsilon(1e-13).margin(1e-15));
      const double root = 2 / (c + std::sqrt(c * c + 4));
      CHECK(dem::solve_rate_equation(std::log(c), 0.5) == Approx(2 * std::log(root)).epsilon(1e-13).margin(1e-15));
      // M = 2: e^beta = (sqrt(1 + 4 c) - 1)/(2 c) = 2/(1 + sqrt(1 + 4 c)).
      CHECK(dem::solve_rate_equation(std::log(c), 2.0) ==
            Approx(std::log(2 / (1 + std::sqrt(1 + 4 * c)))).epsilon(1e-13).margin(1e-15));
    }
}

TEST_CASE("logarithm and rate equation of a pack have the bits of those of each number", "[dem][laws]")
{
  dem::UniformRandom random(2);
  int                different = 0;
  for (int i = 0; i < 3000; ++i)
    {
      double x[dem::pack_size], factor[dem::pack_size], exponent[dem::pack_size];
      for (int lane = 0; lane < dem::pack_size; ++lane)
        {
          x[lane]        = std::pow(10.0, -20 + 40 * random());
          factor[lane]   = -30 + 60 * random();
          exponent[lane] = 0.02 + 2 * random();
        }
      different += differing_lanes(x, x, [](const auto &a, const auto &) { return dem::logarithm(a); });
      different +=
        differing_lanes(factor, exponent, [](const auto &c, const auto &M) { return dem::solve_rate_equation(c, M); });
    }
  CHECK(different == 0);
}
