#include "apps/bench/mortar_constants.h"

#include "apps/bench/laboratory_run.h"
#include "apps/bench/line_fit.h"
#include "apps/bench/mortar_crush.h"
#include "apps/bench/results.h"
#include "apps/text/value_text.h"
#include "base/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <vector>

namespace apps
{
  namespace
  {
    /** What is published of a constant: 1 raises, -1 lowers; nothing: it is not said. */
    struct PublishedEffect
    {
      const char        *name, *entry, *exchanged; ///< in the study; entries of flat-joint in the two readings
      const char        *words;
      std::optional<int> on_strength, on_modulus; ///< 0: there is no trend
    };

    const std::array<PublishedEffect, 8> &published_effects()
    {
      static const std::array<PublishedEffect, 8> all = {{
        {"E_LC", "Contact effective modulus", "Effective modulus", "raises E", std::nullopt, 1},
        {"E_FJ", "Effective modulus", "Contact effective modulus", "raises the peak slightly", 1, std::nullopt},
        {"sigma_c", "Tensile strength", "Tensile strength", "raises the peak slightly", 1, std::nullopt},
        {"c", "Cohesion", "Cohesion", "raises the peak", 1, std::nullopt},
        {"phi", "Friction angle", "Friction angle", "raises the peak", 1, std::nullopt},
        {"mu", "Friction coefficient", "Friction coefficient", "raises the peak", 1, std::nullopt},
        {"k_rat", "Contact stiffness ratio", "Stiffness ratio", "lowers E", std::nullopt, -1},
        {"kbar_rat", "Stiffness ratio", "Contact stiffness ratio", "no clear trend", 0, 0},
      }};
      return all;
    }

    /** Of each constant, ascending. */
    std::vector<double> factors_of(const bool quick)
    {
      return quick ? std::vector<double>{0.25, 1, 1.5} : std::vector<double>{0.25, 0.5, 1, 1.5};
    }
    /** Exponents nearer to zero are no effect: scatter of one specimen. */
    constexpr double least_effect = 0.02;

    /** One reading of the study: which entry each of its constants is, and with which values it begins. */
    struct Reading
    {
      const char              *name;
      bool                     exchanged;
      std::vector<std::string> base; ///< changes of the scene
    };

    constexpr const char *law_section = "Material/flat-joint/";

    std::string change_of(const std::string &entry, const double value)
    {
      return fmt::format("{}{}={}", law_section, entry, value);
    }

    double value_in(const CheckedScene &scene, const std::string &entry)
    {
      const Section *law   = scene.root->find_section("Material")->find_section("flat-joint");
      const Entry   *found = law ? law->find_entry(entry) : nullptr;
      const auto     value = found ? number_in(found->value) : std::nullopt;
      if (!value || !(*value > 0))
        refuse_scene(scene, law_section + entry + ": this bench multiplies it, and needs a value above 0.");
      return *value;
    }

    /** The scene's value of the entry, where both are exchanged that of its counterpart. */
    std::map<std::string, double> values_of(const CheckedScene &scene, const bool exchanged)
    {
      std::map<std::string, double> values;
      for (const PublishedEffect &effect : published_effects())
        values[effect.entry] = value_in(scene, exchanged ? effect.exchanged : effect.entry);
      return values;
    }

    std::vector<Reading> readings_of(const CheckedScene &scene, const bool quick)
    {
      std::vector<Reading> all = {{"as named", false, {}}};
      if (quick)
        return all;
      all.push_back({"exchanged", true, {}});
      for (const auto &[entry, value] : values_of(scene, true))
        all.back().base.push_back(change_of(entry, value));
      return all;
    }

    /** Of one constant in one reading: figures at the factors, and at 1. */
    struct Effect
    {
      const PublishedEffect *of;
      const Reading         *reading;
      std::vector<double>    factor, strength, modulus;

      /** n of value ~ factor^n, by least squares of the logarithms; NaN where a value is not known. */
      double exponent(const std::vector<double> &values) const
      {
        const auto logarithms = [](std::vector<double> numbers) {
          for (double &value : numbers)
            value = std::log(value);
          return numbers;
        };
        return line_through(logarithms(factor), logarithms(values)).slope;
      }

      static bool is_as(const std::optional<int> &published, const double measured)
      {
        const int sign = measured > least_effect ? 1 : measured < -least_effect ? -1 : 0;
        return !published || *published == sign;
      }
      bool as_published() const
      {
        return is_as(of->on_strength, exponent(strength)) && is_as(of->on_modulus, exponent(modulus));
      }
    };

    void write(const BenchResults &results, const std::vector<Effect> &effects)
    {
      std::string csv     = "reading,constant,factor,strength [Pa],modulus [Pa]\n", md;
      const char *reading = nullptr;
      for (const Effect &e : effects)
        {
          if (reading != e.reading->name)
            md += fmt::format("{}Constants {}:\n\n| Constant | Entry | Strength [MPa] at {} | E [GPa] likewise "
                              "| Strength as its power | E as its power | Published | As published "
                              "|\n|---|---|---|---|---|---|---|---|\n",
                              reading ? "\n" : "", e.reading->name, fmt::join(e.factor, ", "));
          reading = e.reading->name;
          std::string strengths, moduli;
          for (std::size_t k = 0; k < e.factor.size(); ++k)
            {
              csv += fmt::format("{},{},{},{},{}\n", e.reading->name, e.of->name, e.factor[k], in_csv(e.strength[k]),
                                 in_csv(e.modulus[k]));
              strengths += (k ? ", " : "") + in_table(e.strength[k], 1e6, "{:.3f}");
              moduli += (k ? ", " : "") + in_table(e.modulus[k], 1e9, "{:.3f}");
            }
          md +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", e.of->name,
                        e.reading->exchanged ? e.of->exchanged : e.of->entry, strengths, moduli,
                        in_table(e.exponent(e.strength), 1, "{:+.2f}"), in_table(e.exponent(e.modulus), 1, "{:+.2f}"),
                        e.of->words, e.as_published() ? "yes" : "no");
        }
      results.write(csv, md);
    }

    postprocess::PlotPanel panel_of(const std::vector<Effect> &effects, const Reading &reading, const bool moduli)
    {
      postprocess::PlotPanel panel;
      panel.title   = fmt::format("{}, constants {}", moduli ? "E" : "Strength", reading.name);
      panel.x_label = "Factor of the constant";
      panel.y_label = moduli ? "E over that of the scene" : "Strength over that of the scene";
      for (const Effect &effect : effects)
        {
          if (effect.reading != &reading)
            continue;
          const std::vector<double> &values = moduli ? effect.modulus : effect.strength;
          postprocess::PlotSeries    line;
          line.name      = effect.of->name;
          line.x         = effect.factor;
          const auto one = std::find(effect.factor.begin(), effect.factor.end(), 1.0) - effect.factor.begin();
          for (const double value : values)
            line.y.push_back(value / values[static_cast<std::size_t>(one)]);
          panel.series.push_back(std::move(line));
        }
      return panel;
    }
  } // namespace

  int run_constants_bench(const MortarBench &bench)
  {
    const BenchResults  results(bench.folder, "constants");
    const CheckedScene  scene    = SceneVariant{}.of(bench.scene, bench.overrides);
    const dem::Packing  packing  = mortar_in(scene).packing();
    const auto          readings = readings_of(scene, bench.quick);
    std::vector<Effect> effects;
    const auto          crushed = [&](const Reading &reading, const std::string &change) {
      SceneVariant variant{reading.name, change, reading.base};
      if (!change.empty())
        variant.changes.push_back(change);
      const CheckedScene checked = variant.of(bench.scene, bench.overrides);
      const MortarRow    row     = crush(variant, mortar_in(checked), packing);
      fmt::print("{:<10} {:<55} strength {} MPa, E {} GPa, {:.1f} s\n", reading.name, change,
                          in_table(row.strength, 1e6, "{:.3f}"), in_table(row.modulus, 1e9, "{:.3f}"), row.cost);
      std::fflush(stdout);
      return row;
    };
    for (const Reading &reading : readings)
      {
        const MortarRow reference = crushed(reading, "");
        const auto      values    = values_of(scene, reading.exchanged);
        for (const PublishedEffect &of : published_effects())
          {
            Effect            effect{&of, &reading, {}, {}, {}};
            const std::string entry = reading.exchanged ? of.exchanged : of.entry;
            for (const double factor : factors_of(bench.quick))
              {
                const MortarRow row =
                  factor == 1 ? reference : crushed(reading, change_of(entry, factor * values.at(entry)));
                effect.factor.push_back(factor);
                effect.strength.push_back(row.strength);
                effect.modulus.push_back(row.modulus);
              }
            effects.push_back(std::move(effect));
            write(results, effects);
          }
      }
    std::vector<postprocess::PlotPanel> panels;
    for (const Reading &reading : readings)
      for (const bool moduli : {false, true})
        panels.push_back(panel_of(effects, reading, moduli));
    return results.finish(panels);
  }
} // namespace apps
