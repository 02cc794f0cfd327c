#include "apps/statistics/ranges.h"

#include <algorithm>

namespace statistics
{
  std::vector<FactorRange> ranges(const std::vector<Factor> &factors, const Eigen::VectorXd &response)
  {
    std::vector<FactorRange> all;
    for (const Factor &factor : factors)
      {
        const Levels levels = levels_of(factor.values);
        FactorRange  range{factor.name, levels.values, std::vector<double>(levels.values.size(), 0.0), 0, 0};
        for (Eigen::Index run = 0; run < response.size(); ++run)
          range.means[levels.of_run[run]] += response[run];
        for (std::size_t level = 0; level < range.means.size(); ++level)
          range.means[level] /= levels.counts[level];
        const auto [least, most] = std::minmax_element(range.means.begin(), range.means.end());
        range.range              = *most - *least;
        all.push_back(std::move(range));
      }
    for (FactorRange &range : all)
      range.rank = 1 + static_cast<int>(std::count_if(all.begin(), all.end(), [&range](const FactorRange &other) {
                     return other.range > range.range;
                   }));
    return all;
  }
} // namespace statistics
