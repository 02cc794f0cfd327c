#include "apps/drivers/uniaxial/summary.h"

#include "apps/drivers/parts/left_out_of_balance.h"
#include "apps/process/progress.h"
#include "apps/process/version.h"
#include "postprocess/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>
#include <numeric>

namespace apps
{
  namespace
  {
    const UniaxialResult &worst_balanced(const std::vector<UniaxialResult> &results)
    {
      return *std::max_element(results.begin(), results.end(), [](const UniaxialResult &a, const UniaxialResult &b) {
        return a.worst_balance_error < b.worst_balance_error;
      });
    }

    std::vector<LabNotes> notes_of(const std::vector<UniaxialResult> &results)
    {
      std::vector<LabNotes> notes;
      for (const UniaxialResult &result : results)
        notes.push_back(result.notes);
      return notes;
    }

    nlohmann::json energy(const UniaxialResult &result)
    {
      nlohmann::json terms = {{"balance_error", result.worst_balance_error}, {"unit", "J"}};
      result.energy.each([&](const std::string &term, const double value) { terms[term] = value; });
      return terms;
    }

    nlohmann::json test_details(const UniaxialResult &result)
    {
      nlohmann::json details      = json_of(result.notes);
      details["contacts"]         = result.at_end.contacts;
      details["steps"]            = result.steps;
      details["stepping_seconds"] = result.stepping_seconds;
      details["energy"]           = energy(result);
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

    nlohmann::json summary;
    summary["scene"]            = request.scene_file;
    summary["asked"]            = {{"kind", "uniaxial"}, {"overrides", request.overrides}};
    summary["version"]          = version();
    summary["figures"]          = figures_of(notes_of(results));
    summary["warnings"]         = warnings_of(notes_of(results));
    summary["cost"]             = {{"particles", first.at_start.particles},
                                   {"links", first.at_start.links},
                                   {"steps", steps},
                                   {"time_step", first.time_step},
                                   {"threads", omp_get_max_threads()},
                                   {"wall_seconds", wall_seconds},
                                   {"link_updates_per_second", updates_per_second(results)}};
    const UniaxialResult &worst = worst_balanced(results);
    summary["energy"]           = energy(worst);
    summary["energy"]["test"]   = name_of(worst.load);
    if (!not_in_balance.empty())
      summary["energy"]["not_in_balance"] = not_in_balance;
    materials.put_into(summary);
    for (const UniaxialResult &result : results)
      summary["tests"].push_back(test_details(result));
    return summary;
  }

  std::string UniaxialReport::draw_curve(const std::filesystem::path &file) const
  {
    std::vector<postprocess::PlotPanel> panels;
    for (const UniaxialResult &result : results)
      {
        const double                   sign = result.load == UniaxialLoad::tension ? 1 : -1;
        postprocess::StressStrainCurve curve{name_of(result.load), {}, {}};
        for (std::size_t i = 0; i < result.strain.size(); ++i)
          {
            curve.strain.push_back(sign * result.strain[i]);
            curve.stress.push_back(sign * result.stress[i]);
          }
        panels.push_back(postprocess::stress_strain_panel(name_of(result.load), {curve}));
      }
    return postprocess::plot(file, panels);
  }

  std::string UniaxialReport::text() const
  {
    std::string text;
    for (const UniaxialResult &result : results)
      text += text_of(result.notes);
    text += basis_of(results.front().notes);
    for (const std::string &warning : warnings_of(notes_of(results)))
      text += fmt::format("warning      {}\n", warning);
    if (const StaticStart &start = results.front().start)
      text += fmt::format("start        {}\n", text_of(*start));
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_balanced(results).worst_balance_error);
    text += balance_note(not_in_balance);
    text += fmt::format("cost         {}, {:.1f} million link updates/s with {} threads\n", duration_text(wall_seconds),
                        1e-6 * updates_per_second(results), omp_get_max_threads());
    return text;
  }
} // namespace apps
