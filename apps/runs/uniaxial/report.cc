#include "apps/runs/uniaxial/report.h"

#include "apps/figures/emission_figures.h"
#include "apps/figures/energy_terms.h"
#include "apps/figures/summary_head.h"
#include "apps/process/progress.h"
#include "apps/specimens/left_out_of_balance.h"
#include "apps/specimens/link_classes.h"
#include "apps/specimens/mix_work.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>
#include <numeric>

namespace apps
{
  namespace
  {
    nlohmann::json test_details(const UniaxialResult &result, const LinkClasses &classes)
    {
      nlohmann::json details = json_of(result.notes);
      if (const nlohmann::json by_class = classes.json(result.link_classes); !by_class.empty())
        details["link_classes"] = by_class;
      details["contacts"]         = result.at_end.contacts;
      details["steps"]            = result.steps;
      details["stepping_seconds"] = result.stepping_seconds;
      details["energy"]           = json_of(result.energy, result.worst_balance_error);
      if (result.start)
        details["initial_equilibrium"] = json_of(*result.start);
      return details;
    }

    double sum(const std::vector<UniaxialResult> &results, double UniaxialResult::*member)
    {
      return std::accumulate(results.begin(), results.end(), 0.0,
                             [member](const double so_far, const UniaxialResult &r) { return so_far + r.*member; });
    }

    double updates_per_second(const std::vector<UniaxialResult> &results)
    {
      return sum(results, &UniaxialResult::link_updates) /
             std::max(sum(results, &UniaxialResult::stepping_seconds), 1e-9);
    }
  } // namespace

  nlohmann::json UniaxialReport::summary() const
  {
    const UniaxialResult &first = results.front();
    std::int64_t          steps = 0;
    for (const UniaxialResult &result : results)
      steps += result.steps;

    nlohmann::json summary = summary_head(request, "uniaxial");
    summary["figures"]     = figures_of(notes_of(results));
    for (const UniaxialResult &result : results)
      {
        summary["figures"].update(EmissionFigures(result.emission).json(result.notes.name + "_"));
        if (result.fracture_zone_width > 0)
          summary["figures"][result.notes.name + "_fracture_zone_width"] = quantity(result.fracture_zone_width, "m");
      }
    summary["warnings"]         = warnings();
    summary["cost"]             = {{"particles", first.at_start.particles},
                                   {"links", first.at_start.links},
                                   {"steps", steps},
                                   {"time_step", first.time_step},
                                   {"threads", omp_get_max_threads()},
                                   {"wall_seconds", wall_seconds},
                                   {"link_updates_per_second", updates_per_second(results)}};
    const UniaxialResult &worst = worst_balanced(results);
    summary["energy"]           = json_of(worst.energy, worst.worst_balance_error);
    summary["energy"]["test"]   = name_of(worst.load);
    if (const std::string left_out = not_in_balance(); !left_out.empty())
      summary["energy"]["not_in_balance"] = left_out;
    test.materials.put_into(summary);
    for (const UniaxialResult &result : results)
      summary["tests"].push_back(test_details(result, LinkClasses(model.link_classes(test.materials.names))));
    model.mixed().put_into(summary);
    return summary;
  }

  std::string UniaxialReport::not_in_balance() const
  {
    return left_out_of_balance(*model.mixed().materials(test.materials.names).bonds(model.physics),
                               test.body().kinematics().radius);
  }

  std::string UniaxialReport::draw_curve(const std::filesystem::path &file) const
  {
    std::vector<postprocess::PlotPanel> panels;
    for (const UniaxialResult &result : results)
      panels.push_back(panel_of(result.load, result.strain, result.stress));
    std::string missing = postprocess::plot(file, panels);
    if (const std::string grading = model.mixed().draw_grading(file.parent_path()); missing.empty())
      missing = grading;
    return missing;
  }

  std::string UniaxialReport::text() const
  {
    std::string text = model.mixed().text();
    for (const UniaxialResult &result : results)
      text += text_of(result.notes) + LinkClasses(model.link_classes(test.materials.names)).text(result.link_classes) +
              EmissionFigures(result.emission).text();
    for (const UniaxialResult &result : results)
      if (result.fracture_zone_width > 0)
        text += fmt::format("{:<12} fracture zone {:.4g} m wide\n", result.notes.name, result.fracture_zone_width);
    text += basis_of(results.front().notes);
    text += warning_lines(warnings());
    if (const StaticStart &start = results.front().start)
      text += fmt::format("start        {}\n", text_of(*start));
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_balanced(results).worst_balance_error);
    text += balance_note(not_in_balance());
    text += fmt::format("cost         {}, {:.1f} million link updates/s with {} threads\n", duration_text(wall_seconds),
                        1e-6 * updates_per_second(results), omp_get_max_threads());
    return text;
  }
} // namespace apps
