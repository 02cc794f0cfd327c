#include "apps/statistics/sample.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>

using namespace statistics;

TEST_CASE("sample: mean and unbiased deviation of 0, 1, ..., n are closed forms", "[statistics]")
{
  for (const int n : {1, 2, 9, 100})
    {
      std::vector<double> values;
      for (int k = 0; k <= n; ++k)
        values.push_back(k);
      INFO(n);
      CHECK(moments_of(values).mean == 0.5 * n);
      // Sum of (k - n/2)^2 = n (n + 1) (n + 2) / 12, over n.
      CHECK(std::fabs(moments_of(values).deviation - std::sqrt((n + 1) * (n + 2) / 12.0)) < 1e-13 * n);
    }
}

TEST_CASE("sample: one value does not scatter, and none has no mean", "[statistics]")
{
  CHECK(moments_of({3e9}).mean == 3e9);
  CHECK(moments_of({3e9}).deviation == 0);
  CHECK(std::isnan(moments_of({}).mean));
  CHECK(moments_of({}).deviation == 0);
  CHECK(moments_of({}).count == 0);
}
