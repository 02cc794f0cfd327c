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
    const auto &forces   = series.column(load);
    const auto  greatest = std::max_element(forces.begin(), forces.end(), [](const double one, const double other) {
      return std::fabs(one) < std::fabs(other);
    });
    const auto  row      = static_cast<std::size_t>(greatest - forces.begin());
    peak                 = std::fabs(*greatest);
    last                 = std::copysign(1.0, *greatest) * forces.back();
    work                 = series.column("energy_work").back();
    if (std::find(series.names.begin(), series.names.end(), "energy_weight") != series.names.end())
      {
        work -= series.column("energy_weight").back();
        if (peak > 0) // the path drives the load so far per unit of its factor
          way = std::fabs(series.column("force_of_load_factor")[row] / peak) * series.column("load_factor").back();
      }
    for (const char *term : {"energy_damage", "energy_friction", "energy_damped"})
      lost += series.column(term).back();
  }

  void WorkOfFracture::put_into(nlohmann::json &figures, const double ligament, const double weight) const
  {
    figures["work_of_fracture"] = quantity((work + of_weight(weight)) / ligament, "J/m^2");
    if (weight > 0)
      {
        figures["work_of_load"] = quantity(work / ligament, "J/m^2");
        figures["deflection"]   = quantity(way, "m");
      }
    figures["dissipated_over_ligament"] = quantity(lost / ligament, "J/m^2");
    figures["load_left"]                = quantity(left(), "-");
  }

  std::string WorkOfFracture::text(const double ligament, const double weight) const
  {
    const double all = (work + of_weight(weight)) / ligament;
    if (weight > 0)
      return fmt::format(
        "work over ligament {:.4g} J/m^2, {:.4g} of it by the load and the rest for {:.4g} N of weight "
        "between the supports, with {:.0f} % of the largest load left; {:.4g} dissipated\n",
        all, work / ligament, weight, 100 * left(), lost / ligament);
    return fmt::format("work over ligament {:.4g} J/m^2, {:.4g} of it dissipated, with {:.0f} % of the largest load "
                       "left\n",
                       all, lost / ligament, 100 * left());
  }

  std::vector<std::string> WorkOfFracture::names(const bool heavy)
  {
    std::vector<std::string> all = {"work_of_fracture", "dissipated_over_ligament", "load_left"};
    if (heavy)
      all.insert(all.end(), {"work_of_load", "deflection"});
    return all;
  }
} // namespace apps
