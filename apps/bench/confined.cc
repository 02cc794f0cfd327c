#include "apps/bench/confined.h"

#include "apps/bench/laboratory_run.h"
#include "apps/bench/line_fit.h"
#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/runs/particles/body.h"
#include "apps/runs/particles/model.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace apps
{
  namespace
  {
    /** One test of the family. */
    struct ConfinedRow
    {
      double pressure = 0, axial_strength = 0, modulus = 0, poisson = 0, strain_at_peak = 0; ///< NaN: not determined
      double worst_pressure = 0; ///< largest deviation of the pressure around the specimen while it is loaded [-]
      double balance = 0, cost = 0;
      std::size_t in_tension = 0, in_shear = 0; ///< elements that broke

      postprocess::StressStrainCurve curve;
    };

    /** sigma_1 = q + k p; NaN from fewer than two strengths. */
    struct MohrCoulomb
    {
      FittedLine line = {unknown_figure, unknown_figure};

      explicit MohrCoulomb(const std::vector<ConfinedRow> &rows)
      {
        std::vector<double> pressure, strength;
        for (const ConfinedRow &row : rows)
          if (!std::isnan(row.axial_strength))
            {
              pressure.push_back(row.pressure);
              strength.push_back(row.axial_strength);
            }
        if (pressure.size() > 1)
          line = line_through(pressure, strength);
      }
      bool   is_known() const { return !std::isnan(line.slope); }
      double angle() const { return std::asin((line.slope - 1) / (line.slope + 1)) * 180 / M_PI; } ///< [degrees]
      double cohesion() const { return line.intercept / (2 * std::sqrt(line.slope)); }             ///< [Pa]
    };

    std::string pressure_entry(const double pressure)
    {
      return fmt::format("Laboratory/Confining pressure={}", pressure);
    }

    ConfinedRow test_at(const ConfinedBench &bench, const double pressure)
    {
      const CheckedScene    checked = SceneVariant{"", "", {pressure_entry(pressure)}}.of(bench.scene, bench.overrides);
      const ParticlesModel &model   = model_of_kind<ParticlesModel>(checked, "particles");
      if (!model.laboratory.confined())
        refuse_scene(checked, "Laboratory/Test: this bench needs biaxial or triaxial compression.");
      const double       start   = base::processor_seconds();
      const dem::Packing packing = model.packing();
      ParticlesBody      body(model, packing);
      body.start();
      ConfinedRow row;
      row.pressure                 = pressure;
      row.balance                  = run_test(body, model.last_time()).balance;
      row.cost                     = base::processor_seconds() - start;
      const dem::TestFigures found = body.test()->figures();
      row.axial_strength           = value_of(found.strength) + pressure;
      row.modulus                  = value_of(found.gauge_modulus);
      row.poisson                  = value_of(found.poisson_slope);
      row.strain_at_peak           = value_of(found.strain_at_peak);
      for (const dem::Break &broken : body.specimen().breaks())
        ++(broken.mode == dem::BreakMode::tension ? row.in_tension : row.in_shear);
      const dem::TestRecord &record = body.test()->record();
      for (std::size_t r = 0; r < record.rows(); ++r)
        row.worst_pressure =
          std::max(row.worst_pressure, std::abs(record.at(r, dem::TestRecord::confinement) / pressure - 1));
      row.curve = {fmt::format("{:g} MPa", 1e-6 * pressure), record.values(dem::TestRecord::strain),
                   record.values(dem::TestRecord::stress), false};
      return row;
    }

    void write(const BenchResults &results, const std::vector<ConfinedRow> &rows)
    {
      std::string csv = "pressure [Pa],axial_strength [Pa],strain_at_peak [-],modulus_by_gauges [Pa],poisson_ratio "
                        "[-],broken_in_tension,broken_otherwise,worst_pressure_error [-],balance_error [-],time [s]\n",
                  md = "| Pressure [MPa] | Axial strength [MPa] | Strain there | E by gauges [GPa] | Poisson's ratio | "
                       "Broken in tension, otherwise | Pressure held to | Energy balance | Time [s] "
                       "|\n|---|---|---|---|---|---|---|---|---|\n";
      for (const ConfinedRow &r : rows)
        {
          csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", r.pressure, in_csv(r.axial_strength),
                             in_csv(r.strain_at_peak), in_csv(r.modulus), in_csv(r.poisson), r.in_tension, r.in_shear,
                             r.worst_pressure, r.balance, r.cost);
          md += fmt::format("| {:g} | {} | {} | {} | {} | {}, {} | {:.1e} | {:.1e} | {:.1f} |\n", 1e-6 * r.pressure,
                            in_table(r.axial_strength, 1e6, "{:.2f}"), in_table(r.strain_at_peak, 1, "{:.2e}"),
                            in_table(r.modulus, 1e9, "{:.3f}"), in_table(r.poisson, 1, "{:.3f}"), r.in_tension,
                            r.in_shear, r.worst_pressure, r.balance, r.cost);
        }
      const MohrCoulomb law(rows);
      if (law.is_known())
        md +=
          fmt::format("\nMohr and Coulomb: {:.2f} MPa + {:.3f} p, angle of friction {:.1f} degrees, cohesion {:.2f} "
                      "MPa.\n",
                      1e-6 * law.line.intercept, law.line.slope, law.angle(), 1e-6 * law.cohesion());
      results.write(csv, md);
    }

    postprocess::PlotPanel strengths(const std::vector<ConfinedRow> &rows)
    {
      postprocess::PlotPanel panel;
      panel.title   = "Axial strength over confining pressure";
      panel.x_label = "Confining pressure [MPa]";
      panel.y_label = "Axial strength [MPa]";
      postprocess::PlotSeries found, fitted;
      found.style = postprocess::PlotSeries::Style::points;
      found.name  = "tests";
      for (const ConfinedRow &row : rows)
        {
          found.x.push_back(1e-6 * row.pressure);
          found.y.push_back(1e-6 * row.axial_strength);
        }
      panel.series.push_back(found);
      const MohrCoulomb law(rows);
      if (!law.is_known())
        return panel;
      fitted.style = postprocess::PlotSeries::Style::line;
      fitted.name  = fmt::format("{:.1f} degrees, cohesion {:.1f} MPa", law.angle(), 1e-6 * law.cohesion());
      for (const double pressure : {0.0, rows.back().pressure})
        {
          fitted.x.push_back(1e-6 * pressure);
          fitted.y.push_back(1e-6 * law.line.at(pressure));
        }
      panel.series.push_back(fitted);
      return panel;
    }
  } // namespace

  int run_confined_bench(const ConfinedBench &bench)
  {
    const BenchResults       results(bench.folder, "confined");
    std::vector<double>      pressures = bench.pressures;
    std::vector<ConfinedRow> rows;
    std::sort(pressures.begin(), pressures.end());
    for (const double pressure : pressures)
      {
        rows.push_back(test_at(bench, pressure));
        write(results, rows);
        fmt::print("{:g} MPa: axial strength {} MPa, {:.1f} s\n", 1e-6 * pressure,
                   in_table(rows.back().axial_strength, 1e6, "{:.2f}"), rows.back().cost);
        std::fflush(stdout);
      }
    std::vector<postprocess::StressStrainCurve> curves;
    for (const ConfinedRow &row : rows)
      curves.push_back(row.curve);
    return results.finish(
      {postprocess::stress_strain_panel("At several confining pressures", curves), strengths(rows)});
  }
} // namespace apps
