#include "apps/runs/particles/report.h"

#include "apps/figures/emission_figures.h"
#include "apps/figures/energy_terms.h"
#include "apps/figures/series_figures.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/progress.h"
#include "apps/runs/particles/break_results.h"
#include "apps/runs/particles/laboratory_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>

namespace apps
{
  MotionReport ParticlesReport::common() const
  {
    const std::string        by_stop = model.stops.what_ended(series);
    std::vector<std::string> doubts  = tension_beyond_apex(model.material);
    if (body.test())
      for (const std::string &warning : LaboratoryReport{model.laboratory, *body.test(), slower}.warnings())
        doubts.push_back(warning);
    if (exchange)
      if (const std::string doubt = model.precice.left_early(*exchange, specimen().time()); !doubt.empty())
        doubts.push_back(doubt);
    return {request,
            "particles",
            body.test_is_over()             ? "test" :
            exchange && exchange->is_over() ? "coupling" :
                                              by_stop,
            specimen().time(),
            materials,
            start,
            series,
            not_in_balance,
            specimen(),
            {},
            doubts};
  }

  nlohmann::json ParticlesReport::figures() const
  {
    nlohmann::json found = nlohmann::json::object();
    for (const ProbeSection &probe : model.probes.probes)
      found[probe.name] = figure_of(series, probe.name, probe.unit());
    found["broken_links"] = specimen().counts().broken;
    found.update(EmissionFigures(specimen()).json());
    if (body.test())
      found["laboratory"] = LaboratoryReport{model.laboratory, *body.test(), slower}.json();
    return found;
  }

  nlohmann::json ParticlesReport::summary() const
  {
    const dem::Counts counts = specimen().counts();
    nlohmann::json    cost   = {{"particles", counts.particles},       {"links", counts.links},
                                {"contacts", counts.contacts},         {"steps", specimen().steps()},
                                {"time_step", specimen().time_step()}, {"wall_seconds", wall_seconds}};
    if (exchange)
      cost.update({{"windows", exchange->windows()}, {"iterations", exchange->iterations()}});
    nlohmann::json found = common().summary(figures(), json_of(specimen().energy()), cost);
    body.put_mix_into(found);
    return found;
  }

  std::string ParticlesReport::text() const
  {
    std::string text;
    for (const ProbeSection &probe : model.probes.probes)
      {
        const std::vector<double> &values = series.column(probe.name);
        const auto [least, largest]       = std::minmax_element(values.begin(), values.end());
        text += fmt::format("{:<24} {:.6g} {} at the end, from {:.6g} to {:.6g} in all\n", probe.name, values.back(),
                            probe.unit(), *least, *largest);
      }
    if (body.test())
      text += LaboratoryReport{model.laboratory, *body.test(), slower}.text();
    if (model.bonded())
      text += model.mixed().text() + body.link_classes().text(body.link_classes().figures(specimen())) +
              BreakResults{specimen(), {}}.text();
    text += common().text();
    text += fmt::format("cost         {}, {} steps with {} threads\n", duration_text(wall_seconds), specimen().steps(),
                        omp_get_max_threads());
    return text;
  }
} // namespace apps
