#include "apps/bench/mortar.h"

#include "apps/bench/laboratory_run.h"
#include "apps/bench/mortar_constants.h"
#include "apps/bench/mortar_crush.h"
#include "apps/bench/results.h"
#include "base/errors.h"
#include "base/stopwatch.h"
#include "dem/statics/quasi_static_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace apps
{
  namespace
  {
    /** One case: what is varied, whether by another packing. */
    struct MortarCase
    {
      SceneVariant variant;
      bool         grows = false;
    };

    /** Largest step of strain along equilibria: a fiftieth of that at the peak of the published mortars. */
    constexpr double static_strain_step = 1e-5;

    /** The same bonds between ends driven as by smooth platens. */
    dem::LoadedNetwork between_smooth_ends(const ParticlesModel &model, const dem::Packing &packing)
    {
      dem::NetworkParameters links;
      links.dimension         = model.physics.dimension;
      links.rotations         = model.physics.rotations;
      links.interaction_ratio = model.source.interaction_ratio;
      links.installation_gap  = model.source.installation_gap;
      links.thickness         = model.source.thickness;
      dem::GripParameters ends;
      ends.thickness = 0.5 * *std::max_element(packing.radius.begin(), packing.radius.end());
      dem::GripPair pair;
      pair.axis = model.laboratory.requested.press.axis;
      pair.layers =
        dem::find_grip_layers({packing.centre, packing.radius, links.dimension, links.thickness}, pair.axis, ends);
      return dem::load_grips(dem::make_network(packing, links, model.material.materials()), pair);
    }

    /** Their modulus while nothing has broken, after one step of equilibrium. */
    MortarRow in_equilibrium(const ParticlesModel &model, const dem::Packing &packing)
    {
      MortarRow                  row{"equilibrium", "elastic"};
      const double               start  = base::processor_seconds();
      const dem::LoadedNetwork   loaded = between_smooth_ends(model, packing);
      dem::QuasiStaticParameters steps;
      steps.sign        = -1;
      steps.strain_step = steps.end_strain = 1e-6;
      dem::QuasiStaticPath path(loaded, model.material.materials(), steps);
      const auto          &point = path.advance();
      row.particles              = packing.size();
      row.bonds                  = loaded.network.links.size();
      row.modulus                = point.stress[loaded.driven] / point.strain[loaded.driven];
      row.strength = row.imbalance = unknown_figure;
      row.balance                  = point.balance_error();
      row.cost                     = base::processor_seconds() - start;
      return row;
    }

    /** Strength, and the secant modulus to half of it, without inertia; the path ends as the test of the scene does. */
    MortarRow along_equilibria(const ParticlesModel &model, const dem::Packing &packing)
    {
      MortarRow row{"equilibrium", "to failure"};
      row.imbalance                   = unknown_figure;
      const double             start  = base::processor_seconds();
      const dem::LoadedNetwork loaded = between_smooth_ends(model, packing);
      row.particles                   = packing.size();
      row.bonds                       = loaded.network.links.size();
      dem::QuasiStaticParameters steps;
      steps.sign        = -1;
      steps.strain_step = static_strain_step;
      steps.end_strain  = model.laboratory.requested.stop_strain;
      steps.end_stress  = model.laboratory.requested.stop_fraction;
      steps.tolerance   = model.laboratory.requested.rest;
      dem::QuasiStaticPath path(loaded, model.material.materials(), steps);
      try
        {
          while (!path.finished())
            row.balance = std::max(row.balance, path.advance().balance_error());
        }
      catch (const base::NumericalError &error)
        {
          fmt::print("{}: not to failure: {}\n", row.study, error.what());
          row.strength = row.modulus = unknown_figure;
          row.cost                   = base::processor_seconds() - start;
          return row;
        }
      const auto stress = [&](const dem::QuasiStaticPoint &p) { return -p.stress[loaded.driven]; };
      for (const dem::QuasiStaticPoint &point : path.points())
        row.strength = std::max(row.strength, stress(point));
      const auto &points = path.points();
      const auto  half =
        std::find_if(points.begin(), points.end(), [&](const auto &p) { return stress(p) >= 0.5 * row.strength; });
      row.modulus = half->stress[loaded.driven] / half->strain[loaded.driven];
      row.cost    = base::processor_seconds() - start;
      return row;
    }

    std::vector<MortarCase> mortar_cases(const bool quick)
    {
      const auto genesis = [](const char *value, const std::string &entry) {
        return MortarCase{{"size of particles", value, {"Specimen/Genesis/" + entry}}, true};
      };
      const auto again = [](const char *study, const char *value, const std::string &entry) {
        return MortarCase{{study, value, {entry}}, false};
      };
      std::vector<MortarCase> all = {{{"reference", "", {}}, true}, again("speed", "times 4", "Laboratory/Speed=0.08")};
      if (quick)
        return all;
      all.push_back(again("speed", "times 2", "Laboratory/Speed=0.04"));
      all.push_back(again("speed", "half", "Laboratory/Speed=0.01"));
      all.push_back(again("damping", "0.3", "Time/Damping=0.3"));
      all.push_back(again("damping", "0.9", "Time/Damping=0.9"));
      for (const char *elements : {"1", "2", "8", "16"})
        all.push_back(again("elements", elements, std::string("Material/flat-joint/Elements=") + elements));
      all.push_back(genesis("times 2", "Size factor=2"));
      all.push_back(genesis("times 1.5", "Size factor=1.5"));
      all.push_back(genesis("times 0.75", "Size factor=0.75"));
      all.push_back(genesis("another seed", "Seed=2"));
      return all;
    }

    void write(const BenchResults &results, const std::vector<MortarRow> &rows)
    {
      std::string csv = "study,value,particles,bonds,strength [Pa],modulus [Pa],platen_imbalance [-],balance_error "
                        "[-],genesis [s],test [s]\n",
                  md  = "| Study | | Particles | Bonds | Strength [MPa] | Modulus [GPa] | Platens differ by | Energy "
                        "balance | Genesis [s] | Test [s] |\n|---|---|---|---|---|---|---|---|---|---|\n";
      for (const MortarRow &r : rows)
        {
          csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", r.study, r.value, r.particles, r.bonds,
                             in_csv(r.strength), in_csv(r.modulus), in_csv(r.imbalance), r.balance, r.growth, r.cost);
          md +=
            fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.1e} | {:.1f} | {:.1f} |\n", r.study, r.value,
                        r.particles, r.bonds, in_table(r.strength, 1e6, "{:.3f}"), in_table(r.modulus, 1e9, "{:.3f}"),
                        in_table(r.imbalance, 0.01, "{:.2f} %"), r.balance, r.growth, r.cost);
        }
      results.write(csv, md);
    }

    postprocess::PlotPanel panel_of(const std::vector<MortarRow> &rows)
    {
      std::vector<CostPoint> points;
      for (const MortarRow &row : rows)
        if (!std::isnan(row.strength))
          points.push_back({row.study, row.cost, std::max(1e-6, std::fabs(row.strength / rows.front().strength - 1))});
      return error_over_cost("strength against that of the scene", "Cost over its test", points);
    }
  } // namespace

  int run_mortar_bench(const MortarBench &bench)
  {
    if (bench.constants)
      return run_constants_bench(bench);
    const BenchResults          results(bench.folder, "mortar");
    std::vector<MortarRow>      rows;
    std::optional<dem::Packing> reference; ///< for cases that grow none of their own
    const auto                  note = [&](const MortarRow &row) {
      rows.push_back(row);
      write(results, rows);
      fmt::print("{:<18} {:<12} {} particles, strength {} MPa, modulus {} GPa, genesis {:.1f} s, test {:.1f} s\n",
                                  row.study, row.value, row.particles, in_table(row.strength, 1e6, "{:.3f}"),
                                  in_table(row.modulus, 1e9, "{:.3f}"), row.growth, row.cost);
      std::fflush(stdout);
    };
    for (const MortarCase &one : mortar_cases(bench.quick))
      {
        const CheckedScene    checked = one.variant.of(bench.scene, bench.overrides);
        const ParticlesModel &model   = mortar_in(checked);
        const double          start   = base::processor_seconds();
        const dem::Packing    packing = one.grows ? model.packing() : *reference;
        const double          growth  = base::processor_seconds() - start;
        if (!reference)
          reference = packing;
        MortarRow row = crush(one.variant, model, packing);
        row.growth    = one.grows ? growth : 0;
        note(row);
        if (rows.size() == 1)
          {
            note(in_equilibrium(model, packing));
            if (bench.static_strength)
              note(along_equilibria(model, packing));
          }
      }
    return results.finish({panel_of(rows)});
  }
} // namespace apps
