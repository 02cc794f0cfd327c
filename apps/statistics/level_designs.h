#pragma once

#include <Eigen/Core>

#include <vector>

namespace statistics
{
  /**
   * Every combination of levels, the last factor changing fastest.
   * @param levels number of them of each factor @return a run a row, levels from 0
   * @throws base::InputError for a factor without a level, or more than a million runs
   */
  Eigen::MatrixXi full_factorial(const std::vector<int> &levels);

  /**
   * The reference first, then each factor at its other levels while all others stay at the reference.
   * @param reference level of each factor @throws base::InputError for a reference that is none of the levels
   */
  Eigen::MatrixXi one_at_a_time(const std::vector<int> &levels, const std::vector<int> &reference);
} // namespace statistics
