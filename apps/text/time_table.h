#pragma once

#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** What an entry says that takes a table in place of a formula: "table press.csv", "table press.csv: force". */
  struct TableName
  {
    std::string file;
    std::string column; ///< "": the only one besides the time
  };

  /** Empty if the value of an entry names no table. */
  std::optional<TableName> table_in(const std::string &value);

  /**
   * A quantity by time, as it was measured: straight between the rows of a table, before the first and after the last as there.
   *
   * The file has a column `time`, or `t` [s], ascending, and the quantity's; a unit in their names may have a prefix, `force [kN]`, `time [ms]`.
   */
  class TimeTable
  {
  public:
    /** @param unit of the quantity in the scene @throws base::InputError naming the file and what is wrong with it */
    TimeTable(const std::string &file, const std::string &column, const std::string &unit);

    double operator()(double time) const;
    double largest() const;                    ///< magnitude of all values
    bool   unit_named() const { return says; } ///< by the file

  private:
    std::vector<double> time, value;
    bool                says = false;
  };
} // namespace apps
