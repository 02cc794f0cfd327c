#include "apps/text/time_table.h"

#include "apps/text/column_unit.h"
#include "apps/text/same_name.h"
#include "apps/text/value_text.h"
#include "base/errors.h"
#include "postprocess/files/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  std::optional<TableName> table_in(const std::string &value)
  {
    const std::string text = trimmed(value), begin = "table ";
    if (text.compare(0, begin.size(), begin) != 0)
      return std::nullopt;
    const std::string rest  = trimmed(text.substr(begin.size()));
    const std::size_t colon = rest.rfind(": ");
    if (colon == std::string::npos)
      return TableName{rest, ""};
    return TableName{trimmed(rest.substr(0, colon)), trimmed(rest.substr(colon + 1))};
  }

  namespace
  {
    std::size_t place_of_column(const postprocess::CsvTable &table, const std::string &name)
    {
      const auto found = std::find_if(table.names.begin(), table.names.end(),
                                      [&](const std::string &one) { return same_name(one, name); });
      if (found == table.names.end())
        throw base::InputError(
          fmt::format("{}: there is no column {}. Columns: {}.", table.origin, name, fmt::join(table.names, ", ")));
      return static_cast<std::size_t>(found - table.names.begin());
    }

    std::size_t place_of_time(const postprocess::CsvTable &table)
    {
      const auto is_time = [](const std::string &name) { return same_name(name, "time") || same_name(name, "t"); };
      const auto found   = std::find_if(table.names.begin(), table.names.end(), is_time);
      return found == table.names.end() ? place_of_column(table, "time") :
                                          static_cast<std::size_t>(found - table.names.begin());
    }

    /** The requested one, or the only one that is not the time. */
    std::size_t
    place_of_quantity(const postprocess::CsvTable &table, const std::string &requested, const std::size_t time)
    {
      if (!requested.empty())
        return place_of_column(table, requested);
      if (table.names.size() != 2)
        throw base::InputError(fmt::format("{}: has {} columns besides the time. Say which: table FILE: COLUMN, of {}.",
                                           table.origin, table.names.size() - 1, fmt::join(table.names, ", ")));
      return 1 - time;
    }

    /** A column whose name says another quantity than the entry has, and that names no unit, is hardly meant. */
    void refuse_other_quantity(const postprocess::CsvTable &table, const std::size_t quantity, const std::string &unit)
    {
      static constexpr std::pair<const char *, const char *> units[] = {
        {"displacement", "m"}, {"velocity", "m/s"}, {"speed", "m/s"}, {"acceleration", "m/s^2"},
        {"force", "N"},        {"pressure", "Pa"},  {"stress", "Pa"}, {"traction", "Pa"}};
      for (const auto &[name, of] : units)
        if (table.units[quantity].empty() && of != unit && has_words(table.names[quantity], name))
          throw base::InputError(fmt::format("{}: column {} is a {} by its name, and a table in [{}] is expected. Give "
                                             "that one, or say by [{}] behind its name that it is one.",
                                             table.origin, table.names[quantity], name, unit, unit));
    }
  } // namespace

  TimeTable::TimeTable(const std::string &file, const std::string &column, const std::string &unit)
  {
    const postprocess::CsvTable table    = postprocess::read_csv_table(file);
    const std::size_t           at       = place_of_time(table);
    const std::size_t           quantity = place_of_quantity(table, column, at);
    refuse_other_quantity(table, quantity, unit);
    time  = column_in(table, at, "s");
    value = column_in(table, quantity, unit);
    says  = !table.units[quantity].empty();
    if (time.empty())
      throw base::InputError(file + ": has no rows. Give one of time and value each.");
    for (std::size_t row = 1; row < time.size(); ++row)
      if (!(time[row] > time[row - 1]))
        throw base::InputError(
          fmt::format("{}: row {}: time {} after {}: times must ascend.", file, row + 1, time[row], time[row - 1]));
  }

  double TimeTable::operator()(const double now) const
  {
    const auto after = std::upper_bound(time.begin(), time.end(), now);
    if (after == time.begin())
      return value.front();
    if (after == time.end())
      return value.back();
    const auto   k    = static_cast<std::size_t>(after - time.begin());
    const double part = (now - time[k - 1]) / (time[k] - time[k - 1]);
    return value[k - 1] + part * (value[k] - value[k - 1]);
  }

  double TimeTable::largest() const
  {
    double most = 0;
    for (const double one : value)
      most = std::max(most, std::abs(one));
    return most;
  }
} // namespace apps
