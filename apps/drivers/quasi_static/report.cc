#include "apps/drivers/quasi_static/report.h"

#include "apps/process/progress.h"
#include "apps/process/version.h"
#include "postprocess/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>

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

    nlohmann::json details_of(const QuasiStaticResult &r)
    {
      nlohmann::json details = json_of(r.notes);
      details["points"] = {{"strain", r.strain_points}, {"opening", r.opening_points}, {"relaxed", r.relaxed_points}};
      details["solutions"]        = r.solutions;
      details["relaxation_steps"] = r.relaxation_steps;
      details["energy"]           = energy_of(r);
      return details;
    }

    std::vector<LabNotes> notes_of(const std::vector<QuasiStaticResult> &results)
    {
      std::vector<LabNotes> notes;
      for (const QuasiStaticResult &r : results)
        notes.push_back(r.notes);
      return notes;
    }
  } // namespace

  nlohmann::json QuasiStaticReport::summary() const
  {
    double       worst     = 0;
    std::int64_t solutions = 0;
    for (const QuasiStaticResult &r : results)
      {
        worst = std::max(worst, r.worst_balance_error);
        solutions += r.solutions;
      }
    nlohmann::json summary;
    summary["scene"]    = request.scene_file;
    summary["asked"]    = {{"kind", "quasi_static"}, {"overrides", request.overrides}};
    summary["version"]  = version();
    summary["figures"]  = figures_of(notes_of(results));
    summary["warnings"] = warnings_of(notes_of(results));
    summary["cost"]     = {{"particles", particles},
                           {"links", links},
                           {"solutions", solutions},
                           {"threads", omp_get_max_threads()},
                           {"wall_seconds", wall_seconds}};
    summary["energy"]   = {{"balance_error", worst}};
    materials.put_into(summary);
    for (const QuasiStaticResult &r : results)
      summary["tests"].push_back(details_of(r));
    return summary;
  }

  std::string QuasiStaticReport::draw_curve(const std::filesystem::path &file) const
  {
    std::vector<postprocess::PlotPanel> panels;
    for (const QuasiStaticResult &r : results)
      {
        const double                   sign = r.load == UniaxialLoad::tension ? 1 : -1;
        postprocess::StressStrainCurve curve{name_of(r.load), {0}, {0}};
        for (std::size_t i = 0; i < r.strain.size(); ++i)
          {
            curve.strain.push_back(sign * r.strain[i]);
            curve.stress.push_back(sign * r.stress[i]);
          }
        panels.push_back(postprocess::stress_strain_panel(name_of(r.load), {curve}));
      }
    return postprocess::plot(file, panels);
  }

  std::string QuasiStaticReport::text() const
  {
    std::string text;
    double      worst = 0;
    for (const QuasiStaticResult &r : results)
      {
        text += text_of(r.notes);
        text += fmt::format("{:<12} {} points led by strain, {} by opening, {} relaxed (cascades)\n", "",
                            r.strain_points, r.opening_points, r.relaxed_points);
        worst = std::max(worst, r.worst_balance_error);
      }
    text += basis_of(results.front().notes);
    for (const std::string &warning : warnings_of(notes_of(results)))
      text += fmt::format("warning      {}\n", warning);
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst);
    text += fmt::format("cost         {} with {} threads\n", duration_text(wall_seconds), omp_get_max_threads());
    return text;
  }
} // namespace apps
