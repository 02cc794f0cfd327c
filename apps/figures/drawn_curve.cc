#include "apps/figures/drawn_curve.h"

#include "apps/results/warning.h"
#include "apps/text/nearest_name.h"
#include "base/errors.h"
#include "postprocess/pictures/drawn_unit.h"

#include <algorithm>
#include <utility>

namespace apps
{
  std::size_t peak_row(const std::vector<double> &values)
  {
    const auto smaller = [](const double a, const double b) { return std::fabs(a) < std::fabs(b); };
    return static_cast<std::size_t>(std::max_element(values.begin(), values.end(), smaller) - values.begin());
  }

  namespace
  {
    struct DrawnColumn
    {
      std::vector<double> values;
      std::string         label;
    };

    DrawnColumn drawn(const postprocess::CsvTable &series, const std::string &name)
    {
      const auto                 column = std::find(series.names.begin(), series.names.end(), name);
      const std::vector<double> &values = series.column(name);
      const double               peak = values[peak_row(values)], sign = peak < 0 ? -1 : 1;
      const auto                 unit =
        postprocess::drawn_unit(peak, series.units[static_cast<std::size_t>(column - series.names.begin())]);
      DrawnColumn result;
      for (const double value : values)
        result.values.push_back(sign * unit.scale * value);
      result.label = (sign < 0 ? "- " : "") + postprocess::readable(name) + unit.label;
      return result;
    }
  } // namespace

  postprocess::PlotPanel drawn_curve(const postprocess::CsvTable &series,
                                     const std::string           &horizontal,
                                     const std::string           &vertical,
                                     const std::string           &title)
  {
    DrawnColumn             x = drawn(series, horizontal), y = drawn(series, vertical);
    postprocess::PlotPanel  panel;
    postprocess::PlotSeries curve;
    panel.title     = title;
    panel.x_label   = x.label;
    panel.y_label   = y.label;
    curve.name      = postprocess::readable(vertical);
    curve.style     = postprocess::PlotSeries::Style::line;
    curve.mark_peak = true;
    curve.x         = std::move(x.values);
    curve.y         = std::move(y.values);
    panel.series.push_back(std::move(curve));
    return panel;
  }

  void write_curve(const std::filesystem::path &folder,
                   const postprocess::CsvTable &series,
                   const std::string           &horizontal,
                   const std::string           &vertical,
                   const std::string           &title,
                   const bool                   from_rest)
  {
    postprocess::PlotPanel panel = drawn_curve(series, horizontal, vertical, title);
    if (from_rest)
      {
        postprocess::PlotSeries &curve = panel.series.front();
        curve.x.insert(curve.x.begin(), 0.0);
        curve.y.insert(curve.y.begin(), 0.0);
      }
    warn_of_missing("curve.png", postprocess::plot(folder / "curve.png", {panel}));
  }

  std::string chosen_column(const std::vector<std::string> &columns,
                            const char                     *entry,
                            const std::string              &requested,
                            const std::string              &otherwise)
  {
    if (!requested.empty() && std::find(columns.begin(), columns.end(), requested) == columns.end())
      throw base::InputError(std::string("Output/") + entry + " = " + requested + ": series.csv has no such column. " +
                             did_you_mean(requested, columns));
    return requested.empty() ? otherwise : requested;
  }
} // namespace apps
