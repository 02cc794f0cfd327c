#include "apps/runs/structure/bending_test.h"

#include "apps/figures/summary_head.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    struct Bent
    {
      double peak = 0, last = 0; ///< load [N]
      double work = 0;           ///< by the load [J]
      double lost = 0;           ///< dissipated [J]
    };

    Bent bent(const postprocess::CsvTable &series, const std::string &load)
    {
      Bent found;
      for (const double force : series.column(load))
        found.peak = std::max(found.peak, std::fabs(force));
      found.last = std::fabs(series.column(load).back());
      found.work = series.column("energy_work").back();
      for (const char *term : {"energy_damage", "energy_friction", "energy_damped"})
        found.lost += series.column(term).back();
      return found;
    }
  } // namespace

  void BendingTestSection::check(const base::EntryPath &root) const
  {
    if (evaluate() && !(notch < depth))
      root.at("Bending test").refuse("Notch depth", "must be below Depth: nothing is left to break.");
  }

  double BendingTestSection::nominal_stress(const double load) const
  {
    const double left = depth - notch;
    return 1.5 * load * span / (width * left * left);
  }

  nlohmann::json BendingTestSection::figures(const postprocess::CsvTable &series, const std::string &load) const
  {
    const Bent found = bent(series, load);
    return {{"nominal_strength", quantity(nominal_stress(found.peak), "Pa")},
            {"work_of_fracture", quantity(found.work / ligament(), "J/m^2")},
            {"dissipated_over_ligament", quantity(found.lost / ligament(), "J/m^2")},
            {"load_left", quantity(found.peak > 0 ? found.last / found.peak : 0, "-")}};
  }

  std::string BendingTestSection::text(const postprocess::CsvTable &series, const std::string &load) const
  {
    const Bent found = bent(series, load);
    return fmt::format("bending      nominal strength {:.4g} MPa; work over ligament {:.4g} J/m^2, {:.4g} of it "
                       "dissipated, with {:.0f} % of "
                       "the largest load left\n",
                       1e-6 * nominal_stress(found.peak), found.work / ligament(), found.lost / ligament(),
                       found.peak > 0 ? 100 * found.last / found.peak : 0);
  }

  std::vector<std::string> BendingTestSection::names()
  {
    return {"bending_test/nominal_strength", "bending_test/work_of_fracture", "bending_test/dissipated_over_ligament",
            "bending_test/load_left"};
  }
} // namespace apps
