#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace statistics
{
  /** A column of a design: the value of one factor in every run. */
  struct Factor
  {
    std::string     name;
    Eigen::VectorXd values;
  };

  /** The different values of a factor, and which run has which. */
  struct Levels
  {
    std::vector<double> values; ///< rising
    std::vector<int>    counts; ///< runs of each
    std::vector<int>    of_run; ///< number of the level, from 0
  };

  Levels levels_of(const Eigen::VectorXd &values);

  /** A column for each level but the last: one there, minus one at the last, zero elsewhere; for a sum of zero over the levels. */
  Eigen::MatrixXd effect_columns(const Levels &levels);
} // namespace statistics
