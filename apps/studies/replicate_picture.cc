#include "apps/studies/replicate_picture.h"

#include "apps/figures/drawn_curve.h"
#include "apps/studies/scene_entry.h"
#include "postprocess/pictures/drawn_unit.h"
#include "postprocess/pictures/plot.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace apps
{
  namespace
  {
    /** What is drawn over what: as section Output says, otherwise stress over strain; nothing where neither is there. */
    std::pair<std::string, std::string> drawn_columns(const CheckedScene &scene, const postprocess::CsvTable &series)
    {
      const auto named = [&](const char *path, const std::string &otherwise) {
        const Entry      *entry = entry_at(*scene.root, path);
        const std::string name  = entry && entry->set && !entry->value.empty() ? entry->value : otherwise;
        return std::find(series.names.begin(), series.names.end(), name) != series.names.end() ? name : "";
      };
      return {named("Output/Curve horizontal", abscissa_of_band(series)), named("Output/Curve vertical", "stress")};
    }

    std::vector<double>
    values_of_test(const postprocess::CsvTable &series, const std::string &column, const std::string &test)
    {
      const std::vector<double> &all   = series.column(column);
      const auto                 found = std::find(series.names.begin(), series.names.end(), "test");
      if (test.empty() || found == series.names.end())
        return all;
      const auto         &tests = series.words[static_cast<std::size_t>(found - series.names.begin())];
      std::vector<double> values;
      for (std::size_t row = 0; row < all.size(); ++row)
        if (tests[row] == test)
          values.push_back(all[row]);
      return values;
    }

    /** Sign and unit in which a column is drawn: its peak upwards. */
    double
    drawn_scale(const std::vector<double> &values, const std::string &name, const std::string &unit, std::string &label)
    {
      const double peak  = values[peak_row(values)];
      const auto   drawn = postprocess::drawn_unit(peak, unit);
      label              = (peak < 0 ? "- " : "") + postprocess::readable(name) + drawn.label;
      return (peak < 0 ? -1 : 1) * drawn.scale;
    }

    std::vector<double> scaled(std::vector<double> values, const double scale)
    {
      for (double &value : values)
        value *= scale;
      return values;
    }

    postprocess::PlotSeries
    line(const std::string &name, std::vector<double> x, std::vector<double> y, const char *colour)
    {
      postprocess::PlotSeries series;
      series.name   = name;
      series.x      = std::move(x);
      series.y      = std::move(y);
      series.colour = colour;
      series.style  = postprocess::PlotSeries::Style::line;
      return series;
    }

    /** Every run, and mean and band of those over whose abscissa there are any. */
    postprocess::PlotPanel band_panel(const std::vector<RunResult>              &runs,
                                      const std::optional<ReplicatedSeries>     &band,
                                      const std::pair<std::string, std::string> &columns,
                                      const std::string                         &test)
    {
      const auto &[horizontal, vertical]   = columns;
      const postprocess::CsvTable &first   = runs.front().series;
      const auto                   unit_of = [&first](const std::string &name) {
        return first.units[static_cast<std::size_t>(std::find(first.names.begin(), first.names.end(), name) -
                                                    first.names.begin())];
      };
      postprocess::PlotPanel panel;
      panel.title = test;
      const double x_scale =
        drawn_scale(values_of_test(first, horizontal, test), horizontal, unit_of(horizontal), panel.x_label);
      const double y_scale =
        drawn_scale(values_of_test(first, vertical, test), vertical, unit_of(vertical), panel.y_label);
      for (const RunResult &run : runs)
        panel.series.push_back(line(&run == &runs.front() ? "each run" : "",
                                    scaled(values_of_test(run.series, horizontal, test), x_scale),
                                    scaled(values_of_test(run.series, vertical, test), y_scale), "#bbbbbb"));
      if (!band || horizontal != band->table.names.front())
        return panel;
      std::vector<double> x, mean, lower, upper;
      for (std::size_t row = 0; row < band->table.rows(); ++row)
        if (band->tests.empty() || band->tests[row] == test)
          {
            const double value     = y_scale * band->table.column(vertical)[row];
            const double deviation = std::fabs(y_scale) * band->table.column(vertical + "_deviation")[row];
            x.push_back(x_scale * band->table.columns[0][row]);
            mean.push_back(value);
            lower.push_back(value - deviation);
            upper.push_back(value + deviation);
          }
      panel.series.push_back(line("mean and standard deviation", x, lower, "#56B4E9"));
      panel.series.push_back(line("", x, upper, "#56B4E9"));
      panel.series.push_back(line("mean", x, mean, "#0072B2"));
      return panel;
    }
  } // namespace

  std::string draw_replicates(const std::filesystem::path           &file,
                              const CheckedScene                    &scene,
                              const std::vector<RunResult>          &runs,
                              const std::optional<ReplicatedSeries> &band)
  {
    const auto columns = drawn_columns(scene, runs.front().series);
    if (columns.first.empty() || columns.second.empty())
      return "the series has no stress, and section Output names no curve";
    std::vector<std::string> tests;
    if (band)
      for (const std::string &test : band->tests)
        if (tests.empty() || tests.back() != test)
          tests.push_back(test);
    if (tests.empty())
      tests.push_back("");
    std::vector<postprocess::PlotPanel> panels;
    for (const std::string &test : tests)
      panels.push_back(band_panel(runs, band, columns, test));
    return postprocess::plot(file, panels);
  }
} // namespace apps
