#pragma once

#include "base/entry_path.h"
#include "postprocess/files/csv_table.h"

#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Stop": a column of the series beyond a value ends the run. */
  struct StopSection
  {
    std::string name, column;
    bool        above     = true;
    double      value     = 0;
    double      from_time = 0; ///< [s]

    bool holds(double present, double time) const
    {
      return time >= from_time && (above ? present > value : present < value);
    }
  };

  /** Section "Stop". */
  struct StopsSection
  {
    std::list<StopSection> stops;

    /** @throws base::InputError for a column that the series does not have */
    void check(const base::EntryPath &root, const std::vector<std::string> &columns) const;
    /** The line of a forecast. @param set_up before the motion [s] @param motion all of it [s] */
    std::string duration_line(double set_up, double motion, double end_time) const;
    /** Name of the first condition that a row fulfils; "" if none does. @param row its first number is the time */
    std::string fulfilled(const std::vector<std::string> &columns, const std::vector<double> &row) const;
    /** What ended a complete run: "end time", or the name of a condition. */
    std::string what_ended(const postprocess::CsvTable &series) const;
  };
} // namespace apps
