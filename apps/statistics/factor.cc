#include "apps/statistics/factor.h"

#include <algorithm>

namespace statistics
{
  Levels levels_of(const Eigen::VectorXd &values)
  {
    Levels levels;
    levels.values.assign(values.begin(), values.end());
    std::sort(levels.values.begin(), levels.values.end());
    levels.values.erase(std::unique(levels.values.begin(), levels.values.end()), levels.values.end());
    levels.counts.assign(levels.values.size(), 0);
    for (const double value : values)
      {
        const auto at = std::lower_bound(levels.values.begin(), levels.values.end(), value);
        levels.of_run.push_back(static_cast<int>(at - levels.values.begin()));
        ++levels.counts[levels.of_run.back()];
      }
    return levels;
  }

  Eigen::MatrixXd effect_columns(const Levels &levels)
  {
    const int       last    = static_cast<int>(levels.values.size()) - 1;
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(levels.of_run.size(), std::max(last, 0));
    for (int run = 0; run < columns.rows(); ++run)
      if (levels.of_run[run] == last)
        columns.row(run).setConstant(-1);
      else
        columns(run, levels.of_run[run]) = 1;
    return columns;
  }
} // namespace statistics
