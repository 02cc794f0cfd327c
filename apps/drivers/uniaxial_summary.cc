#include "apps/drivers/uniaxial_summary.h"

#include "apps/progress.h"
#include "apps/results/result_listing.h"
#include "apps/version.h"
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
    const UniaxialResult *of(const std::vector<UniaxialResult> &results, const UniaxialLoad load)
    {
      const auto found =
        std::find_if(results.begin(), results.end(), [load](const UniaxialResult &r) { return r.load == load; });
      return found == results.end() ? nullptr : &*found;
    }

    const UniaxialResult &worst_balanced(const std::vector<UniaxialResult> &results)
    {
      return *std::max_element(results.begin(), results.end(), [](const UniaxialResult &a, const UniaxialResult &b) {
        return a.worst_balance_error < b.worst_balance_error;
      });
    }

    nlohmann::json quantity(const double value, const char *unit) { return {{"value", value}, {"unit", unit}}; }

    /** The modulus is measured in tension where there is such a test: no sliding disturbs it there. */
    nlohmann::json figures(const std::vector<UniaxialResult> &results)
    {
      const UniaxialResult *tension     = of(results, UniaxialLoad::tension),
                           *compression = of(results, UniaxialLoad::compression);
      nlohmann::json found;
      found["young_modulus"] =
        quantity(tension ? tension->figures.young_modulus : compression->figures.young_modulus, "Pa");
      if (tension)
        {
          found["tensile_strength"]       = quantity(tension->figures.strength, "Pa");
          found["strain_at_tensile_peak"] = quantity(tension->figures.strain_at_peak, "-");
        }
      if (compression)
        {
          found["compressive_strength"]       = quantity(compression->figures.strength, "Pa");
          found["strain_at_compressive_peak"] = quantity(compression->figures.strain_at_peak, "-");
        }
      if (tension && compression)
        found["strength_ratio"] = quantity(compression->figures.strength / tension->figures.strength, "-");
      return found;
    }

    nlohmann::json energy(const UniaxialResult &result)
    {
      nlohmann::json terms = {{"balance_error", result.worst_balance_error}, {"unit", "J"}};
      result.energy.each([&](const std::string &term, const double value) { terms[term] = value; });
      return terms;
    }

    nlohmann::json test_details(const UniaxialResult &result)
    {
      const UniaxialResult &r       = result;
      nlohmann::json        details = {{"name", name_of(r.load)},
                                       {"young_modulus", quantity(r.figures.young_modulus, "Pa")},
                                       {"strength", quantity(r.figures.strength, "Pa")},
                                       {"strain_at_peak", quantity(r.figures.strain_at_peak, "-")},
                                       {"peak_passed", r.peak_passed},
                                       {"broken_links", r.at_end.broken},
                                       {"contacts", r.at_end.contacts},
                                       {"steps", r.steps},
                                       {"stepping_seconds", r.stepping_seconds},
                                       {"energy", energy(r)}};
      if (r.start)
        details["initial_equilibrium"] = json_of(*r.start);
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
    summary["figures"]          = figures(results);
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
      {
        text += fmt::format("{:<12} strength {:.3f} MPa at strain {:.3e}, E {:.2f} GPa, {} of {} links broken{}\n",
                            name_of(result.load), 1e-6 * result.figures.strength, result.figures.strain_at_peak,
                            1e-9 * result.figures.young_modulus, result.at_end.broken, result.at_start.links,
                            result.peak_passed ? "" : " (no peak: the stress still grows)");
      }
    if (const StaticStart &start = results.front().start)
      text += fmt::format("start        {}\n", text_of(*start));
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_balanced(results).worst_balance_error);
    text += fmt::format("cost         {}, {:.1f} million link updates/s with {} threads\n", duration_text(wall_seconds),
                        1e-6 * updates_per_second(results), omp_get_max_threads());
    text += result_listing(request.output_folder);
    return text;
  }
} // namespace apps
