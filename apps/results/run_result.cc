#include "apps/results/run_result.h"

#include "apps/process/exit_status.h"
#include "apps/results/run_outcome.h"
#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace apps
{
  namespace
  {
    /** An object with a value and perhaps its unit, or a bare number. */
    bool is_figure(const nlohmann::json &entry)
    {
      return entry.is_number() || (entry.is_object() && entry.contains("value") && !entry["value"].is_structured());
    }

    void collect(const nlohmann::json &entries, const std::string &path, std::vector<std::string> &found)
    {
      for (const auto &[name, entry] : entries.items())
        if (is_figure(entry))
          found.push_back(path + name);
        else if (entry.is_structured())
          collect(entry, path + name + "/", found);
    }

    Figure figure_of(const nlohmann::json &entry)
    {
      if (entry.is_number())
        return {entry.get<double>(), "", ""};
      Figure figure;
      figure.unit           = entry.value("unit", "");
      figure.not_determined = entry.value("not_determined", "");
      if (const nlohmann::json &value = entry["value"]; value.is_number() && std::isfinite(value.get<double>()))
        figure.value = value.get<double>();
      return figure;
    }

    /** Its object "figures"; an empty one where there is none. */
    nlohmann::json figures_in(const nlohmann::json &summary)
    {
      return summary.is_object() && summary.contains("figures") ? summary["figures"] : nlohmann::json::object();
    }
  } // namespace

  std::vector<std::string> RunResult::figures() const
  {
    std::vector<std::string> found;
    collect(figures_in(summary), "", found);
    return found;
  }

  Figure RunResult::figure(const std::string &path) const
  {
    const std::vector<std::string> known = figures();
    if (std::find(known.begin(), known.end(), path) == known.end())
      throw base::InputError(no_such_figure(path, known));
    return figure_of(figures_in(summary)[nlohmann::json::json_pointer("/" + path)]);
  }

  std::vector<std::string> RunResult::warnings() const
  {
    return summary.is_object() ? summary.value("warnings", std::vector<std::string>()) : std::vector<std::string>();
  }

  std::optional<double> RunResult::balance_error() const
  {
    const nlohmann::json::json_pointer place("/energy/balance_error");
    if (!summary.is_object() || !summary.contains(place) || !summary[place].is_number())
      return std::nullopt;
    return summary[place].get<double>();
  }

  int RunResult::exit_status() const { return end == End::interrupted ? exit_interrupted : exit_success; }

  postprocess::CsvTable empty_series(const std::vector<postprocess::SeriesColumn> &columns, const std::string &origin)
  {
    postprocess::CsvTable series;
    for (const postprocess::SeriesColumn &column : columns)
      {
        series.names.push_back(column.name);
        series.units.push_back(column.unit);
      }
    series.columns.resize(columns.size());
    series.words.resize(columns.size());
    series.origin = origin;
    return series;
  }

  void append(postprocess::CsvTable &series, const SeriesRow &row)
  {
    const std::size_t numbers = row.first.size(), last = numbers + row.values.size();
    if (last + row.last.size() != series.names.size())
      throw std::invalid_argument("a row of " + std::to_string(last + row.last.size()) + " values for " +
                                  std::to_string(series.names.size()) + " columns");
    for (std::size_t c = 0; c < numbers; ++c)
      series.words[c].push_back(row.first[c]);
    for (std::size_t c = numbers; c < last; ++c)
      series.columns[c].push_back(row.values[c - numbers]);
    for (std::size_t c = last; c < series.names.size(); ++c)
      series.words[c].push_back(row.last[c - last]);
  }
} // namespace apps
