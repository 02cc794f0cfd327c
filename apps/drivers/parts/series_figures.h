#pragma once

#include "postprocess/csv_table.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace apps
{
  /** Last, least and largest value of a column of a series, and when: objects "end", "least" and "largest". */
  nlohmann::json figure_of(const postprocess::CsvTable &series, const std::string &name, const std::string &unit);

  /** Largest column "energy_residual" over the largest of the other energies, both of all rows; 0 without energy. */
  double worst_residual(const postprocess::CsvTable &series);
} // namespace apps
