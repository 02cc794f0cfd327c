#include "apps/runs/structure/bending_test.h"

#include "apps/figures/summary_head.h"
#include "apps/runs/structure/work_of_fracture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
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
    const WorkOfFracture found(series, load);
    nlohmann::json       all = {{"nominal_strength", quantity(nominal_stress(found.peak), "Pa")}};
    found.put_into(all, ligament());
    return all;
  }

  std::string BendingTestSection::text(const postprocess::CsvTable &series, const std::string &load) const
  {
    const WorkOfFracture found(series, load);
    return fmt::format("bending      nominal strength {:.4g} MPa; {}", 1e-6 * nominal_stress(found.peak),
                       found.text(ligament()));
  }

  std::vector<std::string> BendingTestSection::names()
  {
    std::vector<std::string> all = {"bending_test/nominal_strength"};
    for (const std::string &name : WorkOfFracture::names())
      all.push_back("bending_test/" + name);
    return all;
  }
} // namespace apps
