#include "apps/runs/structure/wedge_splitting.h"

#include "apps/figures/summary_head.h"
#include "apps/runs/structure/work_of_fracture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace apps
{
  namespace
  {
    double slope_of(const double angle) { return std::tan(0.5 * angle * M_PI / 180); }
  } // namespace

  void WedgeSplittingSection::check(const base::EntryPath &root) const
  {
    if (evaluate() && !(friction * slope_of(angle) < 1))
      root.at("Wedge splitting")
        .refuse("Friction coefficient", "so blunt and rough a wedge never moves: must be below 1/tan(Wedge angle/2).");
  }

  double WedgeSplittingSection::machine_force(const double splitting_force) const
  {
    const double slope = slope_of(angle);
    return 2 * splitting_force * (slope + friction) / (1 - friction * slope);
  }

  double WedgeSplittingSection::nominal_stress(const double splitting_force) const
  {
    return splitting_force / ligament() * (4 + 6 * arm / ligament_depth);
  }

  nlohmann::json WedgeSplittingSection::figures(const postprocess::CsvTable &series, const std::string &load) const
  {
    const WorkOfFracture found(series, load);
    nlohmann::json       all = {{"splitting_force", quantity(found.peak, "N")},
                                {"machine_force", quantity(machine_force(found.peak), "N")},
                                {"nominal_strength", quantity(nominal_stress(found.peak), "Pa")}};
    found.put_into(all, ligament());
    return all;
  }

  std::string WedgeSplittingSection::text(const postprocess::CsvTable &series, const std::string &load) const
  {
    const WorkOfFracture found(series, load);
    return fmt::format("splitting    force {:.4g} N, by the machine {:.4g} N; nominal strength {:.4g} MPa; {}",
                       found.peak, machine_force(found.peak), 1e-6 * nominal_stress(found.peak),
                       found.text(ligament()));
  }

  std::vector<std::string> WedgeSplittingSection::names()
  {
    std::vector<std::string> all = {"splitting_force", "machine_force", "nominal_strength"};
    for (const std::string &name : WorkOfFracture::names(false))
      all.push_back(name);
    for (std::string &name : all)
      name.insert(0, "wedge_splitting/");
    return all;
  }
} // namespace apps
