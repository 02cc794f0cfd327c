#include "apps/figures/series_figures.h"

#include "apps/figures/drawn_curve.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  nlohmann::json figure_of(const postprocess::CsvTable &series,
                           const std::string           &name,
                           const std::string           &unit,
                           const std::string           &clock)
  {
    const std::vector<double> &values = series.column(name), &time = series.column(clock);
    const auto                 least = std::min_element(values.begin(), values.end()) - values.begin();
    const auto                 most  = std::max_element(values.begin(), values.end()) - values.begin();
    const auto                 at    = [&](const std::ptrdiff_t row) {
      return nlohmann::json{{"value", values[static_cast<std::size_t>(row)]},
                            {"unit", unit.empty() ? "-" : unit},
                            {"at_" + clock, time[static_cast<std::size_t>(row)]}};
    };
    return {{"end", at(static_cast<std::ptrdiff_t>(values.size()) - 1)}, {"least", at(least)}, {"largest", at(most)}};
  }

  namespace
  {
    bool ends_with_residual(const std::string &name)
    {
      const std::string end = "_residual";
      return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    }
  } // namespace

  double worst_residual(const postprocess::CsvTable &series, const double rounding)
  {
    const auto largest = [](const std::vector<double> &values) { return std::fabs(values[peak_row(values)]); };
    double     most    = rounding;
    for (const std::string &name : series.names)
      if (name.rfind("energy_", 0) == 0 && name != "energy_balance_error" && !ends_with_residual(name))
        most = std::max(most, largest(series.column(name)));
    return most > 0 ? largest(series.column("energy_residual")) / most : 0;
  }
} // namespace apps
