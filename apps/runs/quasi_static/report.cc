#include "apps/runs/quasi_static/report.h"

#include "apps/figures/summary_head.h"
#include "apps/process/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

namespace apps
{
  namespace
  {
    nlohmann::json energy_of(const QuasiStaticResult &r)
    {
      return {{"unit", "J"},
              {"external_work", r.last.external_work},
              {"stored", r.last.stored},
              {"damage", r.last.damage},
              {"friction", r.last.friction},
              {"damped", r.last.damped},
              {"residual", r.last.energy_residual()},
              {"balance_error", r.worst_balance_error}};
    }

    nlohmann::json details_of(const QuasiStaticResult &r, const LinkClasses &classes)
    {
      nlohmann::json details = json_of(r.notes);
      if (const nlohmann::json by_class = classes.json(r.link_classes); !by_class.empty())
        details["link_classes"] = by_class;
      details["points"] = {{"strain", r.strain_points}, {"opening", r.opening_points}, {"relaxed", r.relaxed_points}};
      details["solutions"]        = r.solutions;
      details["relaxation_steps"] = r.relaxation_steps;
      details["energy"]           = energy_of(r);
      return details;
    }
  } // namespace

  nlohmann::json QuasiStaticReport::summary() const
  {
    std::int64_t solutions = 0;
    for (const QuasiStaticResult &r : results)
      solutions += r.solutions;
    nlohmann::json summary = summary_head(request, "quasi_static");
    summary["figures"]     = figures_of(notes_of(results));
    summary["warnings"]    = warnings();
    summary["cost"]        = {{"particles", test.particles_in()},
                              {"links", test.links_in()},
                              {"solutions", solutions},
                              {"threads", omp_get_max_threads()},
                              {"wall_seconds", wall_seconds}};
    summary["energy"]      = {{"balance_error", worst_balanced(results).worst_balance_error}};
    test.materials.put_into(summary);
    model.mixed().put_into(summary, test.cell_edges());
    for (const QuasiStaticResult &r : results)
      summary["tests"].push_back(details_of(r, test.classes));
    return summary;
  }

  std::string QuasiStaticReport::draw_curve(const std::filesystem::path &file) const
  {
    std::vector<postprocess::PlotPanel> panels;
    for (const QuasiStaticResult &r : results)
      {
        base::Column strain = {0}, stress = {0}; // the unloaded state
        strain.insert(strain.end(), r.strain.begin(), r.strain.end());
        stress.insert(stress.end(), r.stress.begin(), r.stress.end());
        panels.push_back(panel_of(r.load, strain, stress));
      }
    std::string missing = postprocess::plot(file, panels);
    if (const std::string grading = model.mixed().draw_grading(file.parent_path(), test.cell_edges()); missing.empty())
      missing = grading;
    return missing;
  }

  std::string QuasiStaticReport::text() const
  {
    std::string text = model.mixed().text(test.cell_edges());
    for (const QuasiStaticResult &r : results)
      {
        text += text_of(r.notes) + test.classes.text(r.link_classes);
        text += fmt::format("{:<12} {} points controlled by strain, {} by opening, {} relaxed (cascades)\n", "",
                            r.strain_points, r.opening_points, r.relaxed_points);
      }
    text += basis_of(results.front().notes);
    text += warning_lines(warnings());
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_balanced(results).worst_balance_error);
    text += fmt::format("cost         {} with {} threads\n", duration_text(wall_seconds), omp_get_max_threads());
    return text;
  }
} // namespace apps
