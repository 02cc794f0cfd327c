#include "apps/runs/structure/work_of_fracture.h"

#include "apps/figures/summary_head.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  WorkOfFracture::WorkOfFracture(const postprocess::CsvTable &series, const std::string &load)
  {
    for (const double force : series.column(load))
      peak = std::max(peak, std::fabs(force));
    last = std::fabs(series.column(load).back());
    work = series.column("energy_work").back();
    for (const char *term : {"energy_damage", "energy_friction", "energy_damped"})
      lost += series.column(term).back();
  }

  void WorkOfFracture::put_into(nlohmann::json &figures, const double ligament) const
  {
    figures["work_of_fracture"]         = quantity(work / ligament, "J/m^2");
    figures["dissipated_over_ligament"] = quantity(lost / ligament, "J/m^2");
    figures["load_left"]                = quantity(left(), "-");
  }

  std::string WorkOfFracture::text(const double ligament) const
  {
    return fmt::format("work over ligament {:.4g} J/m^2, {:.4g} of it dissipated, with {:.0f} % of the largest load "
                       "left\n",
                       work / ligament, lost / ligament, 100 * left());
  }

  std::vector<std::string> WorkOfFracture::names()
  {
    return {"work_of_fracture", "dissipated_over_ligament", "load_left"};
  }
} // namespace apps
