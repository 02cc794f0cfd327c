#pragma once

#include "apps/results/run_result.h"

#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** A figure of several runs of one scene that differ by their seeds. */
  struct ReplicatedFigure
  {
    std::string                        path, unit; ///< as Figure has them
    std::vector<std::optional<double>> values;     ///< of each run; nothing: it failed, or did not determine the figure
    std::string                        not_determined; ///< why the first run without a value has none

    std::vector<double> determined() const; ///< values of runs that have one
    double              mean() const;       ///< @pre a run has a value
    /** Square root of the unbiased variance, sum (x - mean)^2 / (n - 1); nothing of fewer than two values. */
    std::optional<double> standard_deviation() const;
  };

  /** Every figure that a run has, in the order of the first that has it. @param runs a failed one is without a summary */
  std::vector<ReplicatedFigure> replicated_figures(const std::vector<RunResult> &runs);

  /** The column over which curves of a series are averaged: strain, or time; "" where it has neither. */
  std::string abscissa_of_band(const postprocess::CsvTable &series);

  /** How many rows of a band each test has. */
  constexpr int points_of_band = 200;

  /** Mean curves of several series with their scatter. */
  struct ReplicatedSeries
  {
    std::vector<std::string>               tests;   ///< of each row, if the series have tests
    postprocess::CsvTable                  table;   ///< abscissa; of every other column the mean, and "NAME_deviation"
    std::vector<postprocess::SeriesColumn> columns; ///< of the file: "test", if there are tests, and those of the table
  };

  /**
   * Columns of numbers at equal distances of the abscissa, from where all curves have begun to where the first one ends, test by test;
   * of a curve that turns back what is farther out than all before. Tests that only some runs have are left out.
   * @param all a series each; not empty @throws base::InputError for series without a common part
   */
  ReplicatedSeries replicated_series(const std::vector<postprocess::CsvTable> &all);
} // namespace apps
