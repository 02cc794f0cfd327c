#include "apps/statistics/level_designs.h"

#include "base/errors.h"

#include <string>

namespace statistics
{
  namespace
  {
    constexpr long most_combinations = 1000000;

    void demand_levels(const std::vector<int> &levels)
    {
      for (std::size_t factor = 0; factor < levels.size(); ++factor)
        if (levels[factor] < 1)
          throw base::InputError("design: factor " + std::to_string(factor + 1) + " has no level.");
    }
  } // namespace

  Eigen::MatrixXi full_factorial(const std::vector<int> &levels)
  {
    demand_levels(levels);
    long runs = 1;
    for (const int count : levels)
      if ((runs *= count) > most_combinations)
        throw base::InputError("full factorial design: more than a million combinations of levels.");
    Eigen::MatrixXi design(runs, levels.size());
    for (long run = 0; run < runs; ++run)
      {
        long rest = run;
        for (std::size_t factor = levels.size(); factor-- > 0; rest /= levels[factor])
          design(run, factor) = static_cast<int>(rest % levels[factor]);
      }
    return design;
  }

  Eigen::MatrixXi one_at_a_time(const std::vector<int> &levels, const std::vector<int> &reference)
  {
    demand_levels(levels);
    if (reference.size() != levels.size())
      throw base::InputError("one-at-a-time design: as many references as factors are needed.");
    int runs = 1;
    for (std::size_t factor = 0; factor < levels.size(); ++factor)
      {
        if (reference[factor] < 0 || reference[factor] >= levels[factor])
          throw base::InputError("one-at-a-time design: the reference of factor " + std::to_string(factor + 1) +
                                 " is none of its levels.");
        runs += levels[factor] - 1;
      }
    Eigen::MatrixXi design(runs, levels.size());
    for (std::size_t factor = 0; factor < levels.size(); ++factor)
      design.col(factor).setConstant(reference[factor]);
    int run = 1;
    for (std::size_t factor = 0; factor < levels.size(); ++factor)
      for (int level = 0; level < levels[factor]; ++level)
        if (level != reference[factor])
          design(run++, factor) = level;
    return design;
  }
} // namespace statistics
