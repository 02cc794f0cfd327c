#include "apps/statistics/array_check.h"

#include "base/errors.h"

#include <Eigen/QR>

#include <cmath>
#include <map>

namespace statistics
{
  namespace
  {
    void demand_runs(const std::vector<Factor> &factors)
    {
      if (factors.empty() || factors.front().values.size() == 0)
        throw base::InputError("design: without a factor or a run there is nothing to check.");
      for (const Factor &factor : factors)
        if (factor.values.size() != factors.front().values.size())
          throw base::InputError("design: factor " + factor.name + " has another number of runs than " +
                                 factors.front().name + ".");
    }

    /** Largest n |n_ab - n_a n_b / n| of a pair of factors, a whole number: zero is exact. */
    long disproportion(const Levels &a, const Levels &b)
    {
      const long        runs    = static_cast<long>(a.of_run.size());
      const std::size_t columns = b.values.size();
      std::vector<long> together(a.values.size() * columns, 0);
      for (long run = 0; run < runs; ++run)
        ++together[a.of_run[run] * columns + b.of_run[run]];
      long worst = 0;
      for (std::size_t i = 0; i < a.values.size(); ++i)
        for (std::size_t j = 0; j < columns; ++j)
          worst = std::max(worst, std::labs(runs * together[i * columns + j] - long(a.counts[i]) * b.counts[j]));
      return worst;
    }

    void check_pairs(ArrayCheck &check)
    {
      long worst = 0;
      for (std::size_t a = 0; a < check.levels.size(); ++a)
        for (std::size_t b = a + 1; b < check.levels.size(); ++b)
          if (const long off = disproportion(check.levels[a], check.levels[b]); off > worst)
            {
              worst            = off;
              check.worst_pair = std::make_pair(static_cast<int>(a), static_cast<int>(b));
            }
      check.proportional = worst == 0;
    }

    void find_duplicates(ArrayCheck &check)
    {
      std::map<std::vector<int>, int> first;
      const int                       runs = static_cast<int>(check.levels.front().of_run.size());
      for (int run = 0; run < runs; ++run)
        {
          std::vector<int> row;
          for (const Levels &levels : check.levels)
            row.push_back(levels.of_run[run]);
          const auto [found, is_new] = first.emplace(std::move(row), run);
          if (!is_new)
            check.duplicates.emplace_back(run, found->second);
        }
    }

    void find_rank(ArrayCheck &check)
    {
      const Eigen::Index runs = check.levels.front().of_run.size();
      check.wanted            = 1;
      for (const Levels &levels : check.levels)
        check.wanted += static_cast<int>(levels.values.size()) - 1;
      Eigen::MatrixXd effects(runs, check.wanted);
      effects.col(0).setOnes();
      Eigen::Index column = 1;
      for (const Levels &levels : check.levels)
        {
          const Eigen::MatrixXd own              = effect_columns(levels);
          effects.middleCols(column, own.cols()) = own;
          column += own.cols();
        }
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factorised(effects);
      factorised.setThreshold(1e-10);
      check.rank = static_cast<int>(factorised.rank());
    }
  } // namespace

  ArrayCheck check_array(const std::vector<Factor> &factors)
  {
    demand_runs(factors);
    ArrayCheck check;
    for (const Factor &factor : factors)
      {
        check.levels.push_back(levels_of(factor.values));
        for (const int count : check.levels.back().counts)
          check.balanced = check.balanced && count == check.levels.back().counts.front();
      }
    check_pairs(check);
    find_duplicates(check);
    find_rank(check);
    return check;
  }
} // namespace statistics
