#include "apps/runs/particles/laboratory_report.h"

#include "apps/figures/summary_head.h"
#include "apps/results/warning.h"
#include "postprocess/files/series.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace apps
{
  namespace
  {
    nlohmann::json figure(const dem::Finding &found, const char *unit)
    {
      if (found.found)
        return quantity(found.value, unit);
      return {{"value", nullptr}, {"unit", unit}, {"not_determined", found.why_not}};
    }

    /** @param scale of the value @param unit after it */
    std::string words(const dem::Finding &found, const double scale, const char *unit)
    {
      return found.found ? fmt::format("{:.4g}{}", scale * found.value, unit) : std::string("not determined");
    }

    const std::array<postprocess::SeriesColumn, dem::TestRecord::columns> &record_columns()
    {
      static const std::array<postprocess::SeriesColumn, dem::TestRecord::columns> all = {{{"strain", "-"},
                                                                                           {"stress", "Pa"},
                                                                                           {"force_low", "N"},
                                                                                           {"force_high", "N"},
                                                                                           {"gauge_strain", "-"},
                                                                                           {"lateral_strain", "-"},
                                                                                           {"confinement", "Pa"},
                                                                                           {"kinetic_energy", "J"},
                                                                                           {"work", "J"},
                                                                                           {"force_ratio", "-"},
                                                                                           {"broken_elements", ""},
                                                                                           {"largest_stress", "Pa"},
                                                                                           {"force_difference", "N"}}};
      return all;
    }

    void write_record(const dem::TestRecord &record, const std::filesystem::path &file)
    {
      postprocess::SeriesWriter table(file, {record_columns().begin(), record_columns().end()});
      for (std::size_t row = 0; row < record.rows(); ++row)
        {
          std::vector<double> numbers;
          for (int c = 0; c < dem::TestRecord::columns; ++c)
            numbers.push_back(record.at(row, static_cast<dem::TestRecord::Column>(c)));
          table.append(numbers);
        }
      table.flush();
    }

    /** @param slow the test at half the speed; nullptr: there was none */
    nlohmann::json json_of(const dem::QuasiStatic &how, const dem::LabTest *slow)
    {
      nlohmann::json found;
      found["force_difference"]       = figure(how.imbalance, "-");
      found["most_force_difference"]  = dem::QuasiStatic::most_imbalance;
      found["kinetic_over_work"]      = figure(how.kinetic, "-");
      found["most_kinetic_over_work"] = dem::QuasiStatic::most_kinetic;
      found["force_ratio"]            = figure(how.force_ratio, "-");
      found["strength_at_half_the_speed"] =
        figure(slow ? slow->figures().strength : dem::Finding::none("not checked: set Laboratory/Check speed"), "Pa");
      found["change_at_half_the_speed"] = figure(how.speed, "-");
      found["most_change"]              = dem::QuasiStatic::most_speed;
      found["holds"]                    = how.determined() ? nlohmann::json(how.holds()) : nlohmann::json(nullptr);
      return found;
    }

    /** Of a loading whose criteria are known and do not all hold: which do not. */
    std::string broken_criteria(const dem::QuasiStatic &how)
    {
      std::string all;
      const auto  add = [&all](const dem::Finding &f, const double most, const char *what) {
        if (f.found && f.value >= most)
          all += fmt::format("{}{} {:.2g} % (limit {:g} %)", all.empty() ? "" : ", ", what, 100 * f.value, 100 * most);
      };
      add(how.imbalance, dem::QuasiStatic::most_imbalance, "the two forces differ by up to");
      add(how.kinetic, dem::QuasiStatic::most_kinetic, "the kinetic energy is up to");
      add(how.speed, dem::QuasiStatic::most_speed, "at half the speed the strength differs by");
      return all;
    }

    /** @param top up to which it was checked */
    std::string text_of(const dem::QuasiStatic &how, const char *top)
    {
      const auto part = [](const dem::Finding &f, const double most) {
        return f.found ? fmt::format("{:.2g} ({} {:g})", f.value, f.value < most ? "below" : "NOT below", most) :
                         std::string("not determined");
      };
      return fmt::format(
        "static       {}: up to {}, difference of the two forces over their mean {}, kinetic energy over "
        "work {}, force ratio {}; strength at half the speed {}\n",
        !how.determined() ? "not determined" :
        how.holds()       ? "yes" :
                            "NO",
        top, part(how.imbalance, dem::QuasiStatic::most_imbalance), part(how.kinetic, dem::QuasiStatic::most_kinetic),
        words(how.force_ratio, 1, ""),
        how.speed.found ? "differs by " + part(how.speed, dem::QuasiStatic::most_speed) : std::string("not checked"));
    }
  } // namespace

  dem::QuasiStatic LaboratoryReport::how_static() const
  {
    dem::QuasiStatic how = test.how_static();
    if (slower)
      how.speed = dem::effect_of_speed(test.figures(), slower->figures());
    return how;
  }

  const char *strength_name(const SpecimenTestSection &test)
  {
    using Test = SpecimenTestSection::Test;
    return test.test == Test::tension   ? "tensile_strength" :
           test.test == Test::splitting ? "splitting_strength" :
           test.test == Test::bending   ? "flexural_strength" :
           test.confined()              ? "deviator_strength" :
                                          "compressive_strength";
  }

  std::vector<std::string> names_of_figures(const SpecimenTestSection &test)
  {
    const std::string        strength = strength_name(test);
    std::vector<std::string> names    = {strength,
                                         strength + "_moving_average",
                                      test.confined() ? "largest_deviator" : "largest_stress",
                                         "strain_at_peak",
                                         "young_modulus",
                                         "young_modulus_by_gauges",
                                         "secant_modulus_to_half",
                                         "poisson_ratio_by_slopes",
                                         "poisson_ratio",
                                         "stress_over_force",
                                         "work_of_fracture",
                                         "friction_over_section",
                                         "stress_left"};
    if (test.confined())
      names.insert(names.end(), {"confining_pressure", "axial_strength"});
    if (test.requested.seating_stress > 0)
      names.emplace_back("strain_at_end_of_seating");
    if (test.published.strength > 0)
      names.emplace_back("published/strength");
    if (test.published.modulus > 0)
      names.emplace_back("published/young_modulus");
    if (test.published.poisson > 0)
      names.emplace_back("published/poisson_ratio");
    for (const char *name : {"force_difference", "most_force_difference", "kinetic_over_work", "most_kinetic_over_work",
                             "force_ratio", "strength_at_half_the_speed", "change_at_half_the_speed", "most_change"})
      names.push_back(std::string("quasi_static/") + name);
    return names;
  }

  nlohmann::json LaboratoryReport::json() const
  {
    const dem::TestFigures f = test.figures();
    nlohmann::json         found;
    found["test"]                                                    = requested.name();
    found[strength_name(requested)]                                  = figure(f.strength, "Pa");
    found[strength_name(requested) + std::string("_moving_average")] = figure(f.smooth_strength, "Pa");
    // Under a pressure it is what the strength is: the part above the pressure.
    found[requested.confined() ? "largest_deviator" : "largest_stress"] = figure(f.largest_stress, "Pa");
    found["strain_at_peak"]                                             = figure(f.strain_at_peak, "-");
    found["young_modulus"]                                              = figure(f.modulus, "Pa");
    found["young_modulus_by_gauges"]                                    = figure(f.gauge_modulus, "Pa");
    found["secant_modulus_to_half"]                                     = figure(f.secant_modulus, "Pa");
    found["poisson_ratio_by_slopes"]                                    = figure(f.poisson_slope, "-");
    found["poisson_ratio"]                                              = figure(f.poisson_secant, "-");
    found["stress_over_force"]                                          = quantity(test.stress_of_force(), "1/m^2");
    found.update(fracture_json(f));
    if (requested.published.given())
      found["published"] = requested.published.json(f);
    if (requested.confined())
      {
        dem::Finding axial = f.strength;
        axial.value += requested.requested.pressure;
        found["confining_pressure"] = quantity(requested.requested.pressure, "Pa");
        found["axial_strength"]     = figure(axial, "Pa");
      }
    if (test.parameters().seating_stress > 0)
      found["strain_at_end_of_seating"] = quantity(test.seated_strain(), "-");
    found["quasi_static"] = json_of(how_static(), slower);
    return found;
  }

  nlohmann::json LaboratoryReport::fracture_json(const dem::TestFigures &f) const
  {
    const auto over_area    = [this](const double energy) { return dem::Finding::of(energy / test.fracture_area()); };
    const dem::Finding none = dem::Finding::none("the specimen has not broken: its strength is not determined");
    return {{"work_of_fracture", figure(f.strength.found ? over_area(test.work()) : none, "J/m^2")},
            {"friction_over_section", figure(f.strength.found ? over_area(test.friction()) : none, "J/m^2")},
            {"stress_left", figure(f.strength.found ? dem::Finding::of(test.stress_left()) : none, "-")}};
  }

  std::vector<std::string> LaboratoryReport::warnings() const
  {
    std::vector<std::string> found = test.notes();
    const dem::QuasiStatic   how   = how_static();
    if (how.determined() && !how.holds())
      found.push_back(std::string("the loading was not static up to the ") +
                      (test.past_peak() ? "peak: " : "largest stress: ") + broken_criteria(how) +
                      (slower ? ". Lower Laboratory/Speed" :
                                ". Lower Laboratory/Speed, or see with Laboratory/Check speed whether the strength "
                                "depends on it"));
    return found;
  }

  void LaboratoryReport::write(const std::filesystem::path &folder, const std::string &title) const
  {
    write_record(test.record(), folder / "stress_strain.csv");
    if (slower)
      write_record(slower->record(), folder / "stress_strain_at_half_the_speed.csv");
    const auto strain                                  = test.record().values(dem::TestRecord::strain),
               gauges                                  = test.record().values(dem::TestRecord::gauge_strain),
               stress                                  = test.record().values(dem::TestRecord::stress);
    std::vector<postprocess::StressStrainCurve> curves = {{"by the platens", strain, stress}};
    if (std::any_of(gauges.begin(), gauges.end(), [](const double e) { return e != 0; }))
      curves.push_back({"by gauges", gauges, stress});
    if (slower && slower->record().rows() > 0)
      curves.push_back({"at half the speed", slower->record().values(dem::TestRecord::strain),
                        slower->record().values(dem::TestRecord::stress)});
    if (!strain.empty())
      if (const auto line = requested.published.curve(*std::max_element(strain.begin(), strain.end()),
                                                      *std::max_element(stress.begin(), stress.end())))
        curves.push_back(*line);
    warn_of_missing("stress_strain.png",
                    postprocess::plot(folder / "stress_strain.png",
                                      {postprocess::stress_strain_panel(title + ", " + requested.name(), curves)}));
  }

  std::string LaboratoryReport::strength_text(const dem::TestFigures &f) const
  {
    if (!f.largest_stress.found)
      return f.largest_stress.why_not;
    if (!f.strength.found)
      return fmt::format("largest {} {:.4g} MPa; the strength is not determined, {}",
                         requested.confined() ? "deviator" : "stress", 1e-6 * f.largest_stress.value,
                         f.strength.why_not);
    const double      p = requested.confined() ? requested.requested.pressure : 0.0;
    const std::string axial =
      fmt::format(", axial {:.4g} MPa under {:.4g} MPa", 1e-6 * (f.strength.value + p), 1e-6 * p);
    return fmt::format("{} {:.4g} MPa at strain {:.3e} (moving average {:.4g} MPa){}",
                       requested.confined() ? "deviator strength" : "strength", 1e-6 * f.strength.value,
                       f.strain_at_peak.value, 1e-6 * f.smooth_strength.value, requested.confined() ? axial : "");
  }

  std::string LaboratoryReport::text() const
  {
    const dem::TestFigures f    = test.figures();
    const char *const      top  = f.strength.found ? "the peak" : "the largest stress";
    std::string            text = fmt::format("test         {}: {}\n", requested.name(), strength_text(f));
    text +=
      fmt::format("moduli       at half {} E {}, by gauges {}, Poisson's ratio {}; from the start to there E {}, "
                  "Poisson's ratio {}\n",
                  top, words(f.modulus, 1e-9, " GPa"), words(f.gauge_modulus, 1e-9, " GPa"),
                  words(f.poisson_slope, 1, ""), words(f.secant_modulus, 1e-9, " GPa"), words(f.poisson_secant, 1, ""));
    if (f.strength.found)
      text += fmt::format(
        "fracture     work {:.4g} J/m^2 of the section, {:.4g} of it by friction, with {:.0f} % of the "
        "strength left\n",
        test.work() / test.fracture_area(), test.friction() / test.fracture_area(), 100 * test.stress_left());
    text += requested.published.text(f);
    text += text_of(how_static(), top);
    return text;
  }
} // namespace apps
