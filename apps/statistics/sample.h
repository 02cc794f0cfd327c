#pragma once

#include <cstddef>
#include <vector>

namespace statistics
{
  /** What a sample says of where its distribution lies, and of its scatter. */
  struct SampleMoments
  {
    std::size_t count = 0;
    double      mean  = 0; ///< arithmetic; NaN of no values
    double deviation  = 0; ///< square root of the unbiased variance, sum (x - mean)^2 / (n - 1); 0 of fewer than two
  };

  SampleMoments moments_of(const std::vector<double> &values);
} // namespace statistics
