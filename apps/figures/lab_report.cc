#include "apps/figures/lab_report.h"

#include "apps/figures/summary_head.h"
#include "apps/specimens/deep_overlap.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    nlohmann::json undetermined(const char *unit, const std::string &reason)
    {
      return {{"value", nullptr}, {"unit", unit}, {"not_determined", reason}};
    }

    std::string why_no_strength(const LabNotes &test)
    {
      if (test.figures.strength <= 0)
        return "the specimen never resisted " + test.name;
      return fmt::format(
        "the largest stress, {:.4g} Pa, may be passed yet: at the end of the test the stress had not fallen "
        "to {} of it for good, nor the strain grown to {} times that there",
        test.figures.strength, dem::fallen_part, dem::past_peak_strain);
    }

    nlohmann::json strength_of(const LabNotes &test)
    {
      return test.figures.peak_passed ? quantity(test.figures.strength, "Pa") :
                                        undetermined("Pa", why_no_strength(test));
    }

    nlohmann::json strain_at_peak_of(const LabNotes &test)
    {
      return test.figures.peak_passed ? quantity(test.figures.strain_at_peak, "-") :
                                        undetermined("-", why_no_strength(test));
    }

    nlohmann::json modulus_of(const LabNotes &test)
    {
      return test.figures.modulus_found() ? quantity(test.figures.young_modulus, "Pa") :
                                            undetermined("Pa", "no step lies below a third of the largest stress");
    }

    const LabNotes *find(const std::vector<LabNotes> &tests, const std::string &name)
    {
      const auto found =
        std::find_if(tests.begin(), tests.end(), [&name](const LabNotes &test) { return test.name == name; });
      return found == tests.end() ? nullptr : &*found;
    }
  } // namespace

  void LabNotes::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("young_modulus", figures.young_modulus);
    visitor.scalar("strength", figures.strength);
    visitor.scalar("strain_at_peak", figures.strain_at_peak);
    std::int64_t passed = figures.peak_passed;
    visitor.scalar("peak_passed", passed);
    figures.peak_passed = passed != 0;
    for (const auto &[part, count] : std::initializer_list<std::pair<const char *, std::size_t *>>{
           {"crack_links", &crack.links}, {"crack_cracked", &crack.cracked}, {"crack_broken", &crack.broken}})
      {
        auto stored = static_cast<std::int64_t>(*count);
        visitor.scalar(part, stored);
        *count = static_cast<std::size_t>(stored);
      }
    visitor.scalar("crack_area", crack.area);
    visitor.scalar("crack_area_at_grips", crack.area_at_grips);
    visitor.scalar("section", section);
    visitor.scalar("gauge_length", gauge_length);
    visitor.scalar("deepest_overlap", deepest_overlap);
    double ratio = poisson_ratio.value_or(std::nan(""));
    visitor.scalar("poisson_ratio", ratio);
    poisson_ratio = std::isnan(ratio) ? std::nullopt : std::optional<double>(ratio);
    visitor.scalar("work_of_fracture", work_of_fracture);
    visitor.scalar("stress_left", stress_left);
  }

  void note_work_of_fracture(LabNotes &test, const dem::UniaxialFigures &curve)
  {
    if (!(test.gauge_length > 0) || !(curve.strength > 0))
      return;
    test.work_of_fracture = curve.work * test.gauge_length;
    test.stress_left      = std::fabs(curve.last_stress) / curve.strength;
  }

  nlohmann::json figures_of(const std::vector<LabNotes> &tests)
  {
    // The modulus is measured in tension where there is such a test: no sliding disturbs it there.
    const LabNotes *tension = find(tests, "tension"), *compression = find(tests, "compression");
    nlohmann::json  found;
    found["young_modulus"] = modulus_of(tension ? *tension : tests.front());
    if (tests.front().section > 0)
      {
        found["section"]      = quantity(tests.front().section, "m^2");
        found["gauge_length"] = quantity(tests.front().gauge_length, "m");
      }
    if (tension)
      {
        found["tensile_strength"]       = strength_of(*tension);
        found["strain_at_tensile_peak"] = strain_at_peak_of(*tension);
      }
    if (const LabNotes &elastic = tension ? *tension : tests.front(); elastic.poisson_ratio)
      found["poisson_ratio"] = quantity(*elastic.poisson_ratio, "-");
    if (tension && tension->work_of_fracture > 0)
      {
        found["work_of_fracture"]                = quantity(tension->work_of_fracture, "J/m^2");
        found["work_of_fracture"]["stress_left"] = tension->stress_left; // what is not done yet
      }
    if (compression)
      {
        found["compressive_strength"]       = strength_of(*compression);
        found["strain_at_compressive_peak"] = strain_at_peak_of(*compression);
      }
    if (tension && compression)
      found["strength_ratio"] = tension->figures.peak_passed && compression->figures.peak_passed ?
                                  quantity(compression->figures.strength / tension->figures.strength, "-") :
                                  undetermined("-", "one of the strengths is not");
    return found;
  }

  std::vector<std::string> names_of_figures(const std::vector<UniaxialLoad> &tests, const bool between_grips)
  {
    const auto has = [&tests](const UniaxialLoad load) {
      return std::find(tests.begin(), tests.end(), load) != tests.end();
    };
    std::vector<std::string> names = {"young_modulus", "poisson_ratio"};
    if (between_grips)
      names.insert(names.end(), {"section", "gauge_length"});
    if (has(UniaxialLoad::tension))
      names.insert(names.end(), {"tensile_strength", "strain_at_tensile_peak"});
    if (has(UniaxialLoad::tension) && between_grips)
      names.emplace_back("work_of_fracture");
    if (has(UniaxialLoad::compression))
      names.insert(names.end(), {"compressive_strength", "strain_at_compressive_peak"});
    if (has(UniaxialLoad::tension) && has(UniaxialLoad::compression))
      names.emplace_back("strength_ratio");
    return names;
  }

  nlohmann::json json_of(const LabNotes &test)
  {
    return {{"name", test.name},
            {"young_modulus", modulus_of(test)},
            {"strength", strength_of(test)},
            {"strain_at_peak", strain_at_peak_of(test)},
            {"largest_stress", quantity(test.figures.strength, "Pa")},
            {"peak_passed", test.figures.peak_passed},
            {"cracked_links", test.crack.cracked},
            {"broken_links", test.crack.broken},
            {"crack_area", quantity(test.crack.area, "m^2")},
            {"crack_area_at_grips", quantity(test.crack.area_at_grips, "m^2")}};
  }

  std::vector<std::string> warnings_of(const std::vector<LabNotes> &tests)
  {
    std::vector<std::string> warnings;
    for (const LabNotes &test : tests)
      {
        if (test.section > 0 && test.crack.touches_grip())
          warnings.push_back(fmt::format("{}: a crack touches a grip ({:.0f} % of its area is on links of gripped "
                                         "particles); the strength may be that of the grip",
                                         test.name, 100 * test.crack.area_at_grips / test.crack.area));
        if (const std::string doubt = overlap_warning(test.deepest_overlap); !doubt.empty())
          warnings.push_back(fmt::format("{}: {}", test.name, doubt));
      }
    return warnings;
  }

  std::string text_of(const LabNotes &test)
  {
    const dem::UniaxialFigures &f = test.figures;
    const std::string           strength =
      f.strength <= 0 ?
                  "no strength: " + why_no_strength(test) :
                  fmt::format("{} {:.3f} MPa at strain {:.3e}{}", f.peak_passed ? "strength" : "largest stress",
                              1e-6 * f.strength, f.strain_at_peak, f.peak_passed ? "" : " (no peak: it may be passed yet)");
    const std::string modulus =
      f.modulus_found() ? fmt::format("E {:.2f} GPa", 1e-9 * f.young_modulus) : std::string("E not determined");
    const std::string area =
      test.section > 0 ? fmt::format(", {:.0f} % of the section", 100 * test.crack.area / test.section) : std::string();
    const std::string ratio = test.poisson_ratio ? fmt::format(", nu {:.3f}", *test.poisson_ratio) : std::string();
    const std::string work =
      test.name == "tension" && test.work_of_fracture > 0 ?
        fmt::format("{:<12} work of fracture {:.4g} J/m^2 until {:.0f} % of the largest stress were left\n", "",
                    test.work_of_fracture, 100 * test.stress_left) :
        std::string();
    return fmt::format(
             "{:<12} {}, {}{}\n{:<12} {} of {} links cracked (damage above {}; {} deleted), crack area {:.3g} "
             "m^2{}\n",
             test.name, strength, modulus, ratio, "", test.crack.cracked, test.crack.links, dem::Crack::damage,
             test.crack.broken, test.crack.area, area) +
           work;
  }

  postprocess::PlotPanel panel_of(const UniaxialLoad load, const base::Column &strain, const base::Column &stress)
  {
    const double                   sign = load == UniaxialLoad::tension ? 1 : -1;
    postprocess::StressStrainCurve curve{name_of(load), {}, {}};
    for (std::size_t i = 0; i < strain.size(); ++i)
      {
        curve.strain.push_back(sign * strain[i]);
        curve.stress.push_back(sign * stress[i]);
      }
    return postprocess::stress_strain_panel(name_of(load), {curve});
  }

  std::string basis_of(const LabNotes &test)
  {
    return test.section > 0 ?
             fmt::format("basis        section {:.5g} m^2, gauge length {:.5g} m\n", test.section, test.gauge_length) :
             std::string();
  }
} // namespace apps
