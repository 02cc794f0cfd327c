#pragma once

#include <Eigen/Core>

#include <vector>

namespace statistics
{
  /**
   * Linear orthogonal array of strength two over a Galois field: levels^exponent runs (rows, in lexicographic order), of which every
   * column has each level as often, and every pair of columns each pair of levels (doc/theory/studies.md, 1). Columns stand in
   * lexicographic order too; there are (runs - 1) / (levels - 1) of them. L27 is (3, 3), L81 (3, 4), L243 (3, 5), L64 (4, 3).
   *
   * @param levels 2, 3, 4, 5, 7, 8 or 9 @return levels from 0
   * @throws base::InputError for other levels, or more than 6561 runs
   */
  Eigen::MatrixXi orthogonal_array(int levels, int exponent);

  /**
   * Replace the highest level by the lowest in some columns. Pairs of levels stay in proportion to their counts, main effects
   * therefore orthogonal, but levels are no longer as frequent (Addelman 1962).
   * @param columns numbers from 0 @throws std::invalid_argument for a column that is not there
   */
  Eigen::MatrixXi collapsed(Eigen::MatrixXi array, const std::vector<int> &columns);
} // namespace statistics
