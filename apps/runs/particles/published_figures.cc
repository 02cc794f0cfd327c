#include "apps/runs/particles/published_figures.h"

#include "apps/figures/summary_head.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace
  {
    nlohmann::json beside(const double published, const dem::Finding &found, const char *unit)
    {
      nlohmann::json all          = quantity(published, unit);
      all["found_over_published"] = nullptr;
      if (found.found)
        all["found_over_published"] = found.value / published;
      return all;
    }

    std::string part_of_line(
      const char *name, const double published, const dem::Finding &found, const double scale, const char *unit)
    {
      if (!(published > 0))
        return {};
      const std::string found_here =
        found.found ? fmt::format("{:+.1f} %", 100 * (found.value / published - 1)) : std::string("not determined");
      return fmt::format("; {} {:.4g}{} (here {})", name, scale * published, unit, found_here);
    }
  } // namespace

  nlohmann::json PublishedFigures::json(const dem::TestFigures &found) const
  {
    nlohmann::json all = nlohmann::json::object();
    if (strength > 0)
      all["strength"] = beside(strength, found.strength, "Pa");
    if (modulus > 0)
      all["young_modulus"] = beside(modulus, found.modulus, "Pa");
    if (poisson > 0)
      all["poisson_ratio"] = beside(poisson, found.poisson_secant, "-");
    return all;
  }

  std::string PublishedFigures::text(const dem::TestFigures &found) const
  {
    const std::string line = part_of_line("strength", strength, found.strength, 1e-6, " MPa") +
                             part_of_line("E", modulus, found.modulus, 1e-9, " GPa") +
                             part_of_line("Poisson's ratio", poisson, found.poisson_secant, 1, "");
    return line.empty() ? line : "published    " + line.substr(2) + "\n";
  }

  std::optional<postprocess::StressStrainCurve> PublishedFigures::curve(const double largest_strain,
                                                                        const double largest_stress) const
  {
    if (!(strength > 0 || modulus > 0))
      return std::nullopt;
    postprocess::StressStrainCurve line;
    line.mark_peak   = false;
    line.name        = "published:";
    const double top = strength > 0 ? strength : largest_stress;
    if (modulus > 0)
      {
        line.name += fmt::format(" E {:.4g} GPa", 1e-9 * modulus);
        line.strain = {0, top / modulus};
        line.stress = {0, top};
      }
    if (strength > 0)
      {
        line.name += fmt::format("{} {:.4g} MPa", modulus > 0 ? "," : "", 1e-6 * strength);
        if (line.strain.empty())
          {
            line.strain = {0};
            line.stress = {strength};
          }
        line.strain.push_back(std::max(largest_strain, line.strain.back()));
        line.stress.push_back(strength);
      }
    return line;
  }
} // namespace apps
