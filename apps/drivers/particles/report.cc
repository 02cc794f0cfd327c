#include "apps/drivers/particles/report.h"

#include "apps/drivers/parts/drawn_curve.h"
#include "apps/drivers/parts/left_out_of_balance.h"
#include "apps/process/progress.h"
#include "apps/process/version.h"
#include "apps/results/warning.h"
#include "postprocess/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    /** Last, least and largest value of a column, and when. */
    nlohmann::json figure_of(const postprocess::CsvTable &series, const std::string &name, const std::string &unit)
    {
      const std::vector<double> &values = series.column(name), &time = series.column("time");
      const auto                 least = std::min_element(values.begin(), values.end()) - values.begin();
      const auto                 most  = std::max_element(values.begin(), values.end()) - values.begin();
      const auto                 at    = [&](const std::ptrdiff_t row) {
        return nlohmann::json{{"value", values[static_cast<std::size_t>(row)]},
                              {"unit", unit.empty() ? "-" : unit},
                              {"at_time", time[static_cast<std::size_t>(row)]}};
      };
      return {{"end", at(static_cast<std::ptrdiff_t>(values.size()) - 1)}, {"least", at(least)}, {"largest", at(most)}};
    }
  } // namespace

  std::string ParticlesReport::ended_by() const
  {
    std::vector<double> last;
    for (const auto &column : series.columns)
      last.push_back(column.back());
    const std::string condition = series.rows() > 1 ? model.stops.fulfilled(series.names, last) : "";
    return condition.empty() ? "end time" : condition;
  }

  nlohmann::json ParticlesReport::figures() const
  {
    nlohmann::json found = nlohmann::json::object();
    for (const GaugeSection &gauge : model.gauges.gauges)
      found[gauge.name] = figure_of(series, gauge.name, gauge.unit());
    found["broken_links"] = specimen.counts().broken;
    return found;
  }

  double ParticlesReport::balance_error() const
  {
    const auto largest = [](const std::vector<double> &values) { return std::fabs(values[peak_row(values)]); };
    double     most    = 0;
    for (const std::string &name : series.names)
      if (name.rfind("energy_", 0) == 0 && name != "energy_residual")
        most = std::max(most, largest(series.column(name)));
    return most > 0 ? largest(series.column("energy_residual")) / most : 0;
  }

  nlohmann::json ParticlesReport::energy() const
  {
    nlohmann::json terms = {{"balance_error", balance_error()}, {"unit", "J"}};
    specimen.energy().each([&](const std::string &term, const double value) { terms[term] = value; });
    if (!not_in_balance.empty())
      terms["not_in_balance"] = not_in_balance;
    return terms;
  }

  void ParticlesReport::write(const std::filesystem::path &folder) const
  {
    const dem::Counts counts = specimen.counts();
    nlohmann::json    summary;
    summary["scene"]    = request.scene_file;
    summary["asked"]    = {{"kind", "particles"}, {"overrides", request.overrides}};
    summary["version"]  = version();
    summary["ended_by"] = ended_by();
    summary["end_time"] = {{"value", specimen.time()}, {"unit", "s"}};
    summary["figures"]  = figures();
    summary["energy"]   = energy();
    summary["cost"]     = {{"particles", counts.particles},     {"links", counts.links},
                           {"contacts", counts.contacts},       {"steps", specimen.steps()},
                           {"time_step", specimen.time_step()}, {"threads", omp_get_max_threads()},
                           {"wall_seconds", wall_seconds}};
    materials.put_into(summary);
    if (start)
      summary["initial_equilibrium"] = json_of(*start);
    postprocess::write_json(folder / "summary.json", summary);
    const std::string title = std::filesystem::path(request.scene_file).stem().string();
    warn_of_missing("curve.png", postprocess::plot(folder / "curve.png", {drawn_curve(series, model.curve_horizontal(),
                                                                                      model.curve_vertical(), title)}));
  }

  std::string ParticlesReport::text() const
  {
    std::string text;
    for (const GaugeSection &gauge : model.gauges.gauges)
      text += fmt::format("{:<24} {:.6g} {}\n", gauge.name, series.column(gauge.name).back(), gauge.unit());
    text += fmt::format("ended by     {}, at {:.6g} s\n", ended_by(), specimen.time());
    if (start)
      text += fmt::format("start        {}\n", text_of(*start));
    text += fmt::format("energy       balance error {:.1e} of the largest energy\n", balance_error());
    text += balance_note(not_in_balance);
    text += fmt::format("cost         {}, {} steps with {} threads\n", duration_text(wall_seconds), specimen.steps(),
                        omp_get_max_threads());
    return text;
  }
} // namespace apps
