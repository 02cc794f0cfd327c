#pragma once

#include "postprocess/files/csv_table.h"

#include <cstddef>
#include <string>
#include <vector>

namespace apps
{
  /**
   * A column of a user's table in a unit of the International System. The column may be in that unit with a prefix ("kN" for "N", "mm/s" for
   * "m/s"), in N/mm^2 for Pa, or in per cent or per mille for a pure number ("-"); where its header names no unit it is taken as it is.
   * @throws base::InputError naming file and column: in another unit
   */
  std::vector<double> column_in(const postprocess::CsvTable &table, std::size_t place, const std::string &unit);

  /** Put a column into the unit of the System of which its own is a multiple, if it names one. @throws base::InputError where it is of none */
  void put_in_si(postprocess::CsvTable &table, std::size_t place);
} // namespace apps
