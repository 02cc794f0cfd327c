#include "apps/bench/line_fit.h"

#include <cstddef>
#include <numeric>

namespace apps
{
  FittedLine line_through(const std::vector<double> &x, const std::vector<double> &y)
  {
    const auto   n      = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n,
                 mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double square = 0, product = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
      {
        square += (x[k] - mean_x) * (x[k] - mean_x);
        product += (x[k] - mean_x) * (y[k] - mean_y);
      }
    const double slope = product / square;
    return {mean_y - slope * mean_x, slope};
  }
} // namespace apps
