#include "apps/statistics/sample.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace statistics
{
  SampleMoments moments_of(const std::vector<double> &values)
  {
    SampleMoments found;
    found.count = values.size();
    if (values.empty())
      {
        found.mean = std::numeric_limits<double>::quiet_NaN();
        return found;
      }
    found.mean     = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double squares = 0;
    for (const double value : values)
      squares += (value - found.mean) * (value - found.mean);
    if (values.size() > 1)
      found.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
    return found;
  }
} // namespace statistics
