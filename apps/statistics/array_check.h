#pragma once

#include "apps/statistics/factor.h"

#include <optional>
#include <utility>
#include <vector>

namespace statistics
{
  /** What a table of runs is as a design. */
  struct ArrayCheck
  {
    std::vector<Levels> levels;              ///< of each factor
    bool                balanced     = true; ///< each factor has every level as often
    bool                proportional = true; ///< every pair of factors: n_ab = n_a n_b / n, main effects are orthogonal
    std::optional<std::pair<int, int>> worst_pair; ///< of factors, the farthest from proportion; none where all are
    std::vector<std::pair<int, int>>
        duplicates; ///< runs equal in all factors: a run, and the first one that it repeats; from 0
    int rank   = 0; ///< of the matrix of the mean and all main effects
    int wanted = 0; ///< 1 + sum of (levels - 1)
  };

  /** @throws base::InputError without a factor or a run, or when factors differ in their number of runs */
  ArrayCheck check_array(const std::vector<Factor> &factors);
} // namespace statistics
