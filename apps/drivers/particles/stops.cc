#include "apps/drivers/particles/stops.h"

#include "apps/forecasts/run_forecast.h"
#include "apps/scene/nearest_name.h"

#include <algorithm>

namespace apps
{
  void StopSection::declare(Section &s)
  {
    s.text("Column", column, Need::required).means("Of series.csv: a probe, or another number that it holds");
    s.choice("When", above, {{"above", true}, {"below", false}}, Need::optional)
      .means("The run ends when the column lies above the value, or below it");
    s.number("Value", value, "", Range(), Need::required).means("In the unit of the column");
    s.number("From time", from_time, "s", Range::at_least(0), Need::optional)
      .means("Before it the condition is not looked at");
  }

  void StopsSection::declare(Section &root)
  {
    root
      .section("Stop", "One sub-section per condition that ends the run before the end time, looked at with every row "
                       "of series.csv but the first")
      .named_sections("CONDITION", [this](Section &opened) {
        StopSection &added = stops.emplace_back();
        added.name         = opened.name();
        added.declare(opened);
      });
  }

  void StopsSection::check(const base::EntryPath &root, const std::vector<std::string> &columns) const
  {
    for (const StopSection &stop : stops)
      if (std::find(columns.begin(), columns.end(), stop.column) == columns.end())
        root.at("Stop").at(stop.name).refuse("Column",
                                             "series.csv has no such column. " + did_you_mean(stop.column, columns));
  }

  std::string StopsSection::duration_line(const double set_up, const double motion, const double end_time) const
  {
    double looked_at = end_time;
    for (const StopSection &stop : stops)
      looked_at = std::min(looked_at, stop.from_time);
    const double part = looked_at / end_time; // of one that is looked at to the end exactly 1: then it is no earlier
    return stoppable_duration_line(set_up + motion, looked_at > 0 ? set_up + motion * part : 0);
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
