#include "apps/results/series_panels.h"

#include "postprocess/pictures/drawn_unit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace apps
{
  namespace
  {
    constexpr std::size_t most_panels = 12;

    std::size_t place_of(const postprocess::CsvTable &series, const std::string &name)
    {
      series.column(name); // refuses what is none
      return static_cast<std::size_t>(std::find(series.names.begin(), series.names.end(), name) - series.names.begin());
    }

    double largest_finite(const std::vector<double> &values)
    {
      double largest = 0;
      for (const double value : values)
        if (std::isfinite(value))
          largest = std::max(largest, std::fabs(value));
      return largest;
    }

    /** Rows of each word, in order; all of them where the series has no words. */
    std::vector<std::pair<std::string, std::vector<std::size_t>>> parts_of(const postprocess::CsvTable &series)
    {
      std::vector<std::pair<std::string, std::vector<std::size_t>>> parts;
      const auto                                                    words =
        std::find_if(series.words.begin(), series.words.end(), [](const auto &w) { return !w.empty(); });
      for (std::size_t row = 0; row < series.rows(); ++row)
        {
          const std::string name = words == series.words.end() ? "" : (*words)[row];
          if (parts.empty() || parts.back().first != name)
            parts.push_back({name, {}});
          parts.back().second.push_back(row);
        }
      return parts;
    }

    bool changes(const std::vector<double> &values)
    {
      return std::any_of(values.begin(), values.end(), [&](const double value) { return value != values.front(); });
    }

    bool is_energy(const std::string &name) { return name.rfind("energy_", 0) == 0; }
    bool is_residual(const std::string &name) { return name.find("residual") != std::string::npos; }
  } // namespace

  std::string abscissa_of(const postprocess::CsvTable &series)
  {
    if (std::find(series.names.begin(), series.names.end(), "time") != series.names.end())
      return "time";
    for (std::size_t k = 0; k < series.names.size(); ++k)
      if (!series.columns[k].empty())
        return series.names[k];
    return "";
  }

  namespace
  {
    /** Columns of numbers that are not the same in every row, but for the abscissa; none of a series that shows nothing. */
    std::vector<std::string> changing_columns(const postprocess::CsvTable &series)
    {
      const std::string        horizontal = abscissa_of(series);
      std::vector<std::string> names;
      if (horizontal.empty() || series.rows() < 2)
        return names;
      for (std::size_t k = 0; k < series.names.size(); ++k)
        if (series.names[k] != horizontal && !series.columns[k].empty() && changes(series.columns[k]))
          names.push_back(series.names[k]);
      return names;
    }
  } // namespace

  postprocess::PlotPanel panel_of_columns(const postprocess::CsvTable    &series,
                                          const std::string              &horizontal,
                                          const std::vector<std::string> &verticals)
  {
    const std::size_t x       = place_of(series, horizontal);
    double            largest = 0;
    for (const std::string &vertical : verticals)
      largest = std::max(largest, largest_finite(series.column(vertical)));
    const std::size_t first  = place_of(series, verticals.front());
    const auto        x_unit = postprocess::drawn_unit(largest_finite(series.columns[x]), series.units[x]);
    const auto        y_unit = postprocess::drawn_unit(largest, series.units[first]);

    postprocess::PlotPanel panel;
    panel.x_label = postprocess::readable(horizontal) + x_unit.label;
    panel.y_label = (verticals.size() == 1        ? postprocess::readable(verticals.front()) :
                     is_energy(verticals.front()) ? "Energy" :
                                                    "Value") +
                    y_unit.label;
    const auto parts = parts_of(series);
    for (const std::string &vertical : verticals)
      for (const auto &[word, rows] : parts)
        {
          postprocess::PlotSeries curve;
          curve.style = postprocess::PlotSeries::Style::line;
          curve.name =
            verticals.size() == 1 ? word : postprocess::readable(vertical) + (word.empty() ? "" : ", " + word);
          for (const std::size_t row : rows)
            {
              curve.x.push_back(x_unit.scale * series.columns[x][row]);
              curve.y.push_back(y_unit.scale * series.column(vertical)[row]);
            }
          panel.series.push_back(std::move(curve));
        }
    return panel;
  }

  std::vector<postprocess::PlotPanel> panels_of_columns(const postprocess::CsvTable &series)
  {
    const std::string                   horizontal = abscissa_of(series);
    std::vector<postprocess::PlotPanel> panels;
    for (const std::string &name : changing_columns(series))
      if (!is_energy(name) && panels.size() + 1 < most_panels)
        panels.push_back(panel_of_columns(series, horizontal, {name}));
    return panels;
  }

  std::vector<postprocess::PlotPanel> panels_of_energies(const postprocess::CsvTable &series)
  {
    std::vector<std::string> terms, residuals;
    for (const std::string &name : changing_columns(series))
      if (is_energy(name) && series.units[place_of(series, name)] == "J")
        (is_residual(name) ? residuals : terms).push_back(name); // next to nothing beside the others
    std::vector<postprocess::PlotPanel> panels;
    for (const std::vector<std::string> &together : {terms, residuals})
      if (!together.empty())
        panels.push_back(panel_of_columns(series, abscissa_of(series), together));
    return panels;
  }

  std::vector<postprocess::PlotPanel> panels_of_series(const postprocess::CsvTable &series)
  {
    std::vector<postprocess::PlotPanel> panels = panels_of_columns(series);
    std::vector<std::string>            terms;
    for (const std::string &name : changing_columns(series))
      if (is_energy(name) && !is_residual(name))
        terms.push_back(name);
    if (!terms.empty())
      panels.push_back(panel_of_columns(series, abscissa_of(series), terms));
    return panels;
  }
} // namespace apps
