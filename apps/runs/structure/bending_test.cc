#include "apps/runs/structure/bending_test.h"

#include "apps/figures/summary_head.h"
#include "apps/runs/structure/work_of_fracture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  void BendingTestSection::check(const base::EntryPath &root, const bool heavy) const
  {
    const base::EntryPath s = root.at("Bending test");
    if (evaluate() && !(notch < depth))
      s.refuse("Notch depth", "must be below Depth: nothing is left to break.");
    if (evaluate() && heavy && length < span)
      s.refuse("Length", "must not be below Span: the beam reaches over its supports.");
  }

  double BendingTestSection::nominal_stress(const double load) const
  {
    const double left = depth - notch;
    return 1.5 * load * span / (width * left * left);
  }

  nlohmann::json
  BendingTestSection::figures(const postprocess::CsvTable &series, const std::string &load, const double weight) const
  {
    const WorkOfFracture found(series, load);
    nlohmann::json       all = {{"nominal_strength", quantity(nominal_stress(found.peak), "Pa")}};
    found.put_into(all, ligament(), weight_between(weight));
    return all;
  }

  std::string
  BendingTestSection::text(const postprocess::CsvTable &series, const std::string &load, const double weight) const
  {
    const WorkOfFracture found(series, load);
    return fmt::format("bending      nominal strength {:.4g} MPa; {}", 1e-6 * nominal_stress(found.peak),
                       found.text(ligament(), weight_between(weight)));
  }

  std::vector<std::string> BendingTestSection::names(const bool heavy)
  {
    std::vector<std::string> all = {"bending_test/nominal_strength"};
    for (const std::string &name : WorkOfFracture::names(heavy))
      all.push_back("bending_test/" + name);
    return all;
  }
} // namespace apps
