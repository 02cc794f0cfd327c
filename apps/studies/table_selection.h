#pragma once

#include "apps/statistics/factor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What of a table of runs is analysed. */
  struct TableSelection
  {
    std::filesystem::path           file;
    std::vector<statistics::Factor> factors;      ///< names without unit
    std::vector<std::string>        factor_units; ///< of each, "" where the table names none
    std::string                     response, response_unit;
    Eigen::VectorXd                 values; ///< of the response
    std::vector<std::string>        runs;   ///< as the column `run` has them, or lines from 1
    std::vector<std::pair<int, int>>
                             copies;   ///< from 0: a run that is equal to an earlier one in every column but `run`
    std::vector<std::string> left_out; ///< runs without a response
  };

  /** A column of a table without its unit: "E [GPa]" and "E_GPa" are E, in GPa. "mu_g" is no mu in grams. */
  struct ColumnTitle
  {
    std::string name, unit;
  };
  ColumnTitle column_title(const std::string &column);

  /**
   * Read the requested columns, with or without their unit; other columns may hold words. Runs of which the response is not a number
   * are left out.
   * @throws base::InputError naming the file and the column: not there, named twice, not a number, no run left
   */
  TableSelection
  select(const std::filesystem::path &file, const std::string &response, const std::vector<std::string> &factors);
} // namespace apps
