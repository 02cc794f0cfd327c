#include "apps/drivers/coupled/report.h"

#include "apps/drivers/continuum/gauges.h"
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

#include <cmath>

namespace apps
{
  nlohmann::json CoupledReport::figures() const
  {
    nlohmann::json found = nlohmann::json::object();
    for (const postprocess::SeriesColumn &column : body.told())
      found[column.name] = figure_of(series, column.name, column.unit);
    if (model.laboratory.given())
      found.update(figures_of({notes()}));
    found["broken_links"] = body.particles().specimen().counts().broken;
    for (const CouplingSection &coupling : model.couplings.couplings)
      if (coupling.bond.given())
        found["torn_off"][coupling.name] = series.column(column_name(coupling.name) + "_torn").back();
    if (body.interface().touched())
      body.interface().put_into(found, model.references);
    return found;
  }

  LabNotes CoupledReport::notes() const
  {
    const dem::Specimen &specimen = body.particles().specimen();
    LabNotes             found;
    found.name    = "compression";
    found.figures = LaboratorySection::figures(series);
    found.crack =
      dem::measure_crack(specimen.particles(), specimen.links(),
                         {model.dimension(), model.particles.source.density, model.particles.source.thickness});
    found.section      = model.laboratory.area;
    found.gauge_length = model.laboratory.length;
    return found;
  }

  nlohmann::json CoupledReport::energy() const
  {
    nlohmann::json    terms = {{"balance_error", worst_residual(series)}, {"unit", "J"}};
    const std::string all   = "energy_";
    for (const std::string &name : series.names)
      if (name.rfind(all, 0) == 0)
        terms[name.substr(all.size())] = series.column(name).back();
    for (const CouplingSection &coupling : model.couplings.couplings)
      terms["made_by_couplings"][coupling.name] = series.column(column_name(coupling.name) + "_made").back();
    if (!not_in_balance.empty())
      terms["not_in_balance"] = not_in_balance;
    return terms;
  }

  nlohmann::json CoupledReport::cost() const
  {
    const dem::Specimen &specimen = body.particles().specimen();
    const dem::Counts    counts   = specimen.counts();
    const CoupledSteps   steps    = body.steps();
    return {{"particles", counts.particles},
            {"links", counts.links},
            {"contacts", counts.contacts},
            {"elements", body.elements()},
            {"unknowns", body.unknowns()},
            {"windows", body.windows()},
            {"particle_steps", specimen.steps()},
            {"stable_step_of_solid", steps.solid},
            {"stable_step_of_particles", steps.particles},
            {"threads", omp_get_max_threads()},
            {"wall_seconds", wall_seconds}};
  }

  void CoupledReport::write(const std::filesystem::path &folder) const
  {
    nlohmann::json summary;
    summary["scene"]    = request.scene_file;
    summary["asked"]    = {{"kind", "coupled"}, {"overrides", request.overrides}};
    summary["version"]  = version();
    summary["ended_by"] = model.particles.stops.what_ended(series);
    summary["end_time"] = {{"value", body.time()}, {"unit", "s"}};
    summary["figures"]  = figures();
    summary["energy"]   = energy();
    summary["cost"]     = cost();
    materials.put_into(summary);
    if (start)
      summary["initial_equilibrium"] = json_of(*start);
    postprocess::write_json(folder / "summary.json", summary);
    const std::string title           = std::filesystem::path(request.scene_file).stem().string();
    const auto [horizontal, vertical] = model.curve(body.columns(), body.told());
    warn_of_missing("curve.png",
                    postprocess::plot(folder / "curve.png", {drawn_curve(series, horizontal, vertical, title)}));
  }

  std::string CoupledReport::text() const
  {
    std::string text;
    for (const postprocess::SeriesColumn &column : body.told())
      text += fmt::format("{:<40} {:.6g} {}\n", column.name, series.column(column.name).back(), column.unit);
    text += body.interface().touched() ? body.interface().text() : "warning      nothing has ever touched the solid\n";
    if (model.laboratory.given())
      text += text_of(notes());
    text += fmt::format("ended by     {}, at {:.6g} s\n", model.particles.stops.what_ended(series), body.time());
    if (start)
      text += fmt::format("start        {}\n", text_of(*start));
    text += fmt::format("energy       balance error {:.1e} of the largest energy\n", worst_residual(series));
    text += balance_note(not_in_balance);
    text += fmt::format("cost         {}, {} windows with {} threads\n", duration_text(wall_seconds), body.windows(),
                        omp_get_max_threads());
    return text;
  }
} // namespace apps
