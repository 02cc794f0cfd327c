#include "dem/core/exponential.h"

#include "dem/core/uniform_random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace
{
  std::int64_t bits(const double a)
  {
    std::int64_t result;
    std::memcpy(&result, &a, sizeof(result));
    return result;
  }

  /** Distance to e^x in units of the last place of e^x; the reference is the 64-bit mantissa of long double. */
  double error_in_ulp(const double x)
  {
    const long double exact = expl(x);
    const double      next  = std::nextafter(static_cast<double>(exact), 1e300);
    const long double ulp   = next - static_cast<long double>(static_cast<double>(exact));
    return static_cast<double>(std::fabs(dem::exponential(x) - exact) / ulp);
  }
} // namespace

TEST_CASE("exponential of a non-positive number is within two units in the last place", "[dem]")
{
  double             largest = 0;
  dem::UniformRandom random(1);
  for (int i = 0; i < 200000; ++i)
    {
      largest = std::max(largest, error_in_ulp(-700.0 * random()));
      largest = std::max(largest, error_in_ulp(-std::pow(10.0, -17 + 19 * random())));
    }
  for (int k = 0; k < 1000; ++k) // around the jumps of the argument reduction, (k + 1/2) ln 2
    for (const double off : {-1e-12, 0.0, 1e-12})
      largest = std::max(largest, error_in_ulp(-(k + 0.5) * std::log(2.0) * (1 + off)));
  CHECK(largest <= 2.0);
}

TEST_CASE("exponential is one at zero and vanishes below -700", "[dem]")
{
  CHECK(dem::exponential(0.0) == 1.0);
  CHECK(dem::exponential(-0.0) == 1.0);
  CHECK(dem::exponential(-700.0) > 0.0);
  CHECK(dem::exponential(std::nextafter(-700.0, -701.0)) == 0.0);
  CHECK(dem::exponential(-1e300) == 0.0);
}

TEST_CASE("exponential of a pack has the bits of the exponential of each number", "[dem]")
{
  dem::UniformRandom random(2);
  int                different = 0;
  for (int i = 0; i < 20000; ++i)
    {
      alignas(64) double x[dem::pack_size], e[dem::pack_size];
      for (auto &value : x)
        value = -std::pow(10.0, -6 + 9 * random());
      dem::store(dem::exponential(dem::load(x)), e);
      for (int lane = 0; lane < dem::pack_size; ++lane)
        different += bits(e[lane]) != bits(dem::exponential(x[lane]));
    }
  CHECK(different == 0);
}
