#include "apps/runs/particles/stops.h"

#include "apps/forecasts/run_forecast.h"
#include "apps/text/nearest_name.h"

#include <algorithm>

namespace apps
{
  void StopsSection::check(const base::EntryPath &root, const std::vector<std::string> &columns) const
  {
    for (const StopSection &stop : stops)
      if (std::find(columns.begin(), columns.end(), stop.column) == columns.end())
        root.at("Stop").at(stop.name).refuse("Column",
                                             "series.csv has no such column. " + did_you_mean(stop.column, columns));
  }

  std::string StopsSection::duration_line(const double set_up, const double motion, const double end_time) const
  {
    double checked_until = end_time;
    for (const StopSection &stop : stops)
      checked_until = std::min(checked_until, stop.from_time);
    const double part =
      checked_until / end_time; // of one that is checked up to the end exactly 1: then it is no earlier
    return stoppable_duration_line(set_up + motion, checked_until > 0 ? set_up + motion * part : 0);
  }

  std::string StopsSection::fulfilled(const std::vector<std::string> &columns, const std::vector<double> &row) const
  {
    for (const StopSection &stop : stops)
      {
        const auto place = std::find(columns.begin(), columns.end(), stop.column) - columns.begin();
        if (stop.holds(row.at(static_cast<std::size_t>(place)), row.front()))
          return stop.name;
      }
    return "";
  }

  std::string StopsSection::what_ended(const postprocess::CsvTable &series) const
  {
    std::vector<double> last;
    for (const auto &column : series.columns)
      last.push_back(column.back());
    const std::string condition = series.rows() > 1 ? fulfilled(series.names, last) : "";
    return condition.empty() ? "end time" : condition;
  }
} // namespace apps
