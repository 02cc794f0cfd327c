#include "apps/drivers/particles/report.h"

#include "apps/drivers/parts/drawn_curve.h"
#include "apps/drivers/parts/left_out_of_balance.h"
#include "apps/drivers/parts/series_figures.h"
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
  nlohmann::json ParticlesReport::figures() const
  {
    nlohmann::json found = nlohmann::json::object();
    for (const GaugeSection &gauge : model.gauges.gauges)
      found[gauge.name] = figure_of(series, gauge.name, gauge.unit());
    found["broken_links"] = specimen.counts().broken;
    return found;
  }

  nlohmann::json ParticlesReport::energy() const
  {
    nlohmann::json terms = {{"balance_error", worst_residual(series)}, {"unit", "J"}};
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
    summary["ended_by"] = model.stops.what_ended(series);
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
    text += fmt::format("ended by     {}, at {:.6g} s\n", model.stops.what_ended(series), specimen.time());
    if (start)
      text += fmt::format("start        {}\n", text_of(*start));
    text += fmt::format("energy       balance error {:.1e} of the largest energy\n", worst_residual(series));
    text += balance_note(not_in_balance);
    text += fmt::format("cost         {}, {} steps with {} threads\n", duration_text(wall_seconds), specimen.steps(),
                        omp_get_max_threads());
    return text;
  }
} // namespace apps
