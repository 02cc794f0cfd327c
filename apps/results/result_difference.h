#pragma once

#include "apps/results/run_result.h"

#include <limits>
#include <string>
#include <vector>

namespace apps
{
  /** A figure or a column of the series in two results. */
  struct ResultDifference
  {
    std::string name, unit;
    double      first = 0, second = 0; ///< figures; of a column where it differs most
    long        row  = -1;             ///< of the series, from 1; -1 for a figure
    double      part = 0;              ///< difference over the larger magnitude; of a column over its largest [-]
    std::string only;                  ///< "first" or "second" where the other one has none, then nothing else counts
  };

  /** Figures that differ in any bit, and columns, in the order of the first result. */
  std::vector<ResultDifference> differing_figures(const RunResult &first, const RunResult &second);
  std::vector<ResultDifference> differing_columns(const postprocess::CsvTable &first,
                                                  const postprocess::CsvTable &second);

  /** Names of files in both folders, not in folders below; of those with equal and of those with other bytes. */
  struct ComparedFiles
  {
    std::vector<std::string> same, other, only_first, only_second;
  };
  ComparedFiles compared_files(const std::filesystem::path &first, const std::filesystem::path &second);
} // namespace apps
