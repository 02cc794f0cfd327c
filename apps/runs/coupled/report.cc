#include "apps/runs/coupled/report.h"

#include "apps/figures/emission_figures.h"
#include "apps/figures/series_figures.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/progress.h"
#include "apps/runs/continuum/probe_column.h"
#include "apps/runs/particles/break_results.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>
#include <cstdint>

namespace apps
{
  MotionReport CoupledReport::common() const
  {
    const std::string invalid = body.end_of_validity();
    return {request,
            "coupled",
            invalid.empty() ? model.particles.stops.what_ended(series) : "end of validity: " + invalid,
            body.time(),
            materials,
            start,
            series,
            not_in_balance,
            body.particles().specimen(),
            body.notes(),
            warnings()};
  }

  nlohmann::json CoupledReport::summary() const
  {
    nlohmann::json found = common().summary(figures(), energy(), cost());
    body.particles().put_mix_into(found);
    return found;
  }

  std::vector<std::string> CoupledReport::warnings() const
  {
    std::vector<std::string> all = body.doubts();
    for (const std::string &doubt : tension_beyond_apex(model.particles.material))
      all.push_back(doubt);
    if (!body.interface().touched() && model.handshakes.empty())
      all.emplace_back("nothing has ever touched the solid");
    else
      for (const std::string &group : body.particles().untouched_groups())
        all.push_back(
          fmt::format("Particles/Initial velocity/{}: it moves at the end as it was thrown, and has touched "
                      "nothing. Check its place, its velocity and Time/End time",
                      group));
    if (const std::string doubt = body.interface().doubt(); !doubt.empty())
      all.push_back(doubt);
    return all;
  }

  nlohmann::json CoupledReport::figures() const
  {
    nlohmann::json found = nlohmann::json::object();
    for (const postprocess::SeriesColumn &column : body.reported())
      found[column.name] = figure_of(series, column.name, column.unit);
    if (model.laboratory.given())
      found.update(figures_of({notes()}));
    found["broken_links"] = static_cast<std::int64_t>(series.column("broken_links").back());
    found.update(EmissionFigures(body.particles().specimen()).json());
    for (const CouplingSection &coupling : model.couplings.couplings)
      if (coupling.bond.given())
        found["torn_off"][coupling.name] = series.column(column_name(coupling.name) + "_torn").back();
    if (body.interface().touched())
      body.interface().put_into(found, model.references);
    return found;
  }

  LabNotes CoupledReport::notes() const
  {
    const dem::ObservedSpecimen &specimen = body.particles().specimen();
    LabNotes                     found;
    found.name         = "compression";
    found.figures      = LaboratorySection::figures(series);
    found.crack        = dem::measure_crack(specimen);
    found.section      = model.laboratory.area;
    found.gauge_length = model.laboratory.length;
    return found;
  }

  nlohmann::json CoupledReport::energy() const
  {
    nlohmann::json    terms;
    const std::string all = "energy_";
    for (const std::string &name : series.names)
      if (name.rfind(all, 0) == 0)
        terms[name.substr(all.size())] = series.column(name).back();
    for (const CouplingSection &coupling : model.couplings.couplings)
      {
        const auto last = [&](const char *term) { return series.column(column_name(coupling.name) + term).back(); };
        terms["spurious_of_couplings"][coupling.name] = last("_spurious");
        terms["spurious_of_contacts"][coupling.name]  = last("_spurious_of_contacts");
      }
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      {
        terms["spurious_of_couplings"][handshake.name] =
          series.column(column_name(handshake.name) + "_spurious").back();
        terms["absorbed"][handshake.name] = series.column(column_name(handshake.name) + "_absorbed").back();
      }
    return terms;
  }

  nlohmann::json CoupledReport::cost() const
  {
    const dem::ObservedSpecimen &specimen = body.particles().specimen();
    const dem::Counts            counts   = specimen.counts();
    const CoupledSteps           steps    = body.steps();
    return {{"particles", counts.particles},
            {"links", counts.links},
            {"contacts", counts.contacts},
            {"elements", body.elements()},
            {"unknowns", body.unknowns()},
            {"windows", body.windows()},
            {"windows_taken_back", body.windows_taken_back()},
            {"particle_steps", specimen.steps()},
            {"stable_step_of_solid", steps.solid},
            {"stable_step_of_particles", steps.particles},
            {"wall_seconds", wall_seconds}};
  }

  std::string CoupledReport::text() const
  {
    std::string text;
    for (const postprocess::SeriesColumn &column : body.reported())
      {
        const std::vector<double> &values = series.column(column.name);
        const auto [least, largest]       = std::minmax_element(values.begin(), values.end());
        text += fmt::format("{:<40} {:.6g} {} at the end, from {:.6g} to {:.6g} in all\n", column.name, values.back(),
                            column.unit, *least, *largest);
      }
    for (const HandshakeSection &handshake : model.handshakes.handshakes)
      text += fmt::format("{:<12} {} damaged bonds in the overlap, {:.4g} J absorbed\n", "handshake",
                          series.column(column_name(handshake.name) + "_damaged").back(),
                          series.column(column_name(handshake.name) + "_absorbed").back());
    if (const std::string mismatch = body.text_of_mismatch(); !mismatch.empty())
      text += fmt::format("{:<12} {}\n", "medium", mismatch);
    if (body.interface().touched())
      text += body.interface().text("particles with the solid");
    if (model.laboratory.given())
      text += text_of(notes());
    if (model.particles.bonded())
      text += model.particles.mixed().text() + BreakResults{body.particles().specimen(), {}}.text();
    text += common().text();
    const std::int64_t again = body.windows_taken_back();
    text += fmt::format("cost         {}, {} windows{} with {} threads\n", duration_text(wall_seconds), body.windows(),
                        again > 0 ? fmt::format(", {} taken back,", again) : "", omp_get_max_threads());
    return text;
  }
} // namespace apps
