#include "apps/drivers/continuum/summary.h"

#include "apps/drivers/parts/drawn_curve.h"
#include "apps/process/mpi_session.h"
#include "apps/process/progress.h"
#include "apps/process/version.h"
#include "postprocess/plot.h"
#include "postprocess/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace apps
{
  namespace
  {
    bool starts_with(const std::string &text, const char *start) { return text.rfind(start, 0) == 0; }

    nlohmann::json quantity(const double value, const std::string &unit)
    {
      return {{"value", value}, {"unit", unit.empty() ? "-" : unit}};
    }
  } // namespace

  double ContinuumReport::last(const std::string &column) const { return series.column(column).back(); }

  double ContinuumReport::worst_balance() const
  {
    const auto &errors = series.column("energy_balance_error");
    return *std::max_element(errors.begin(), errors.end());
  }

  nlohmann::json ContinuumReport::figures() const
  {
    nlohmann::json     found;
    const std::string &clock = series.names.front();
    for (std::size_t i = 0; i < series.names.size(); ++i)
      {
        const std::string &name   = series.names[i];
        const auto        &values = series.columns[i];
        const std::size_t  row    = peak_row(values);
        if (starts_with(name, "reaction_") || starts_with(name, "load_"))
          {
            found["peak_" + name]                = quantity(values[row], series.units[i]);
            found["peak_" + name]["at_" + clock] = series.columns[0][row];
            if (std::count(series.names.begin(), series.names.end(), "opening") > 0)
              found["peak_" + name]["at_opening"] = series.column("opening")[row];
          }
        if (starts_with(name, "displacement_") || name == "opening")
          found["final_" + name] = quantity(values.back(), series.units[i]);
      }
    found["dissipated_energy"]     = quantity(last("energy_dissipated"), "J");
    found["largest_damage"]        = quantity(last("largest_damage"), "-");
    found["largest_crack_opening"] = quantity(last("largest_crack_opening"), "m");
    return found;
  }

  nlohmann::json ContinuumReport::summary() const
  {
    nlohmann::json summary;
    summary["scene"]    = request.scene_file;
    summary["asked"]    = {{"kind", "continuum"}, {"overrides", request.overrides}};
    summary["version"]  = version();
    summary["ended_by"] = ended_by;
    summary["figures"]  = figures();
    summary["cost"]     = {{"elements", size.elements},
                           {"unknowns", size.unknowns},
                           {"integration_points", size.points},
                           {"ranks", rank_count()},
                           {"wall_seconds", wall_seconds}};
    for (const auto &[name, value] : cost)
      summary["cost"][name] = value;
    if (!linear_solver.empty())
      summary["cost"]["linear_solver"] = linear_solver;
    if (!is_static && cost.at("stepping_seconds") > 0)
      summary["cost"]["point_updates_per_second"] = cost.at("steps") * size.points / cost.at("stepping_seconds");
    summary["energy"] = {{"balance_error", worst_balance()}, {"unit", "J"}};
    for (const std::string &name : series.names)
      if (starts_with(name, "energy_") && name != "energy_balance_error")
        summary["energy"][name.substr(7)] = last(name);
    return summary;
  }

  void ContinuumReport::write(const std::filesystem::path &folder) const
  {
    postprocess::write_json(folder / "summary.json", summary());
    postprocess::PlotPanel panel =
      drawn_curve(series, horizontal, vertical, std::filesystem::path(request.scene_file).stem().string());
    if (from_rest) // the state before the first step
      {
        postprocess::PlotSeries &curve = panel.series.front();
        curve.x.insert(curve.x.begin(), 0.0);
        curve.y.insert(curve.y.begin(), 0.0);
      }
    const std::string problem = postprocess::plot(folder / "curve.png", {panel});
    if (!problem.empty())
      fmt::print(stderr, "breccia: warning: no curve.png: {}\n", problem);
  }

  std::string ContinuumReport::text() const
  {
    std::string          text;
    const nlohmann::json found = figures();
    for (const auto &[name, figure] : found.items())
      text += fmt::format("{:<40} {:.6g} {}\n", name, figure["value"].get<double>(), figure["unit"].get<std::string>());
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_balance());
    text += fmt::format("cost         {}, {:.0f} steps{}\n", duration_text(wall_seconds), cost.at("steps"),
                        linear_solver.empty() ? "" : ", " + linear_solver);
    return text;
  }
} // namespace apps
