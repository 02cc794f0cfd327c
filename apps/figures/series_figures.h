#pragma once

#include "postprocess/files/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** Last, least and largest value of a column of a series, and when: objects "end", "least" and "largest". @param clock column that says when */
  nlohmann::json figure_of(const postprocess::CsvTable &series,
                           const std::string           &name,
                           const std::string           &unit,
                           const std::string           &clock = "time");

  /**
   * Largest value of the column "energy_residual" over the largest energy, both of all rows: a run that ends at rest has only rounding
   * left to divide by. 0 without energy.
   * @param rounding what energies are at least divided by [J]: a run that rests all the time has nothing else (dem::EnergyAccount)
   */
  double worst_residual(const postprocess::CsvTable &series, double rounding = 0);
} // namespace apps
