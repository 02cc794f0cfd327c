#pragma once

#include "apps/statistics/factor.h"

#include <vector>

namespace statistics
{
  /** How far the mean response goes with one factor. */
  struct FactorRange
  {
    std::string         factor;
    std::vector<double> levels; ///< rising
    std::vector<double> means;  ///< of the response at each level
    double              range = 0;
    int                 rank  = 0; ///< 1: the largest range
  };

  /** Range analysis, in the order of the factors. Means, not sums: levels may differ in their number of runs. */
  std::vector<FactorRange> ranges(const std::vector<Factor> &factors, const Eigen::VectorXd &response);
} // namespace statistics
