#include "apps/bench/quasi_static.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/runs/quasi_static/lab_test.h"
#include "apps/runs/uniaxial/lab_test.h"
#include "apps/runs/uniaxial/model.h"
#include "apps/specimens/specimen_packing.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <string>

namespace apps
{
  namespace
  {
    constexpr double strain_step = 5e-6, strain_per_sample = 1e-7, stop_fraction = 0.8, stop_strain = 1e-3;

    struct RateRow
    {
      double               rate = 0; ///< [1/s]; 0: quasi-static
      dem::UniaxialFigures figures;
      double               balance_error = 0;
      std::int64_t         steps         = 0; ///< time steps, or linear solutions
      double               cost          = 0; ///< processor time [s]
    };

    /** The scene, pulled only, with the specimen of the bench. */
    UniaxialModel model_of(const CheckedScene &scene, const QuasiStaticBench &bench)
    {
      UniaxialModel model = model_of_kind<UniaxialModel>(scene, "uniaxial");
      if (model.source.source != SpecimenSection::Source::generator || model.physics.dimension != 3)
        refuse_scene(scene, "Specimen/Source and Physics/Dimension: this bench makes its own specimen of spheres and "
                            "needs the generator.");
      const double edge                   = bench.edge * model.source.generator.radius;
      model.source.box                    = {edge, edge, 1.5 * edge};
      model.source.generator.cell_count   = bench.cell_particles;
      model.loading.tests                 = {UniaxialLoad::tension};
      model.loading.axis                  = 2;
      model.loading.tension.stop_fraction = stop_fraction;
      model.loading.tension.stop_strain   = stop_strain;
      model.output.samples                = static_cast<std::int64_t>(stop_strain / strain_per_sample);
      return model;
    }

    RateRow follow(const UniaxialModel &model, const dem::Packing &packing)
    {
      QuasiStaticModel still;
      still.source             = model.source;
      still.rotations          = model.physics.rotations;
      still.material           = model.material;
      still.tests              = model.loading.tests;
      still.axis               = model.loading.axis;
      still.grips              = model.loading.grips;
      still.lateral_blocked    = model.loading.lateral_blocked;
      still.spin_blocked       = model.loading.spin_blocked;
      still.grips_turn         = model.loading.grips_turn;
      still.tension            = {strain_step, stop_fraction, stop_strain};
      const double       start = base::processor_seconds();
      QuasiStaticLabTest test(still, packing, 0);
      while (!test.finished())
        test.advance();
      RateRow row;
      row.figures       = test.result.notes.figures;
      row.balance_error = test.result.worst_balance_error;
      row.steps         = test.result.solutions;
      row.cost          = base::processor_seconds() - start;
      return row;
    }

    RateRow pull(UniaxialModel model, const dem::Packing &packing, const double rate)
    {
      model.loading.tension.rate = rate;
      const double    start      = base::processor_seconds();
      UniaxialLabTest test(model, packing, 0);
      while (!test.finished())
        test.advance();
      RateRow row;
      row.rate          = rate;
      row.figures       = test.result.notes.figures;
      row.balance_error = test.result.worst_balance_error;
      row.steps         = test.result.steps;
      row.cost          = base::processor_seconds() - start;
      return row;
    }

    void announce(const RateRow &row, const RateRow &still)
    {
      fmt::print("{:<22} strength {:.4f} MPa ({:+.2f} %) at {:.3e}, E {:.3f} GPa, {} {}, {:.2f} s, balance {:.1e}\n",
                 row.rate > 0 ? fmt::format("dynamic, {} 1/s", row.rate) : "quasi-static", 1e-6 * row.figures.strength,
                 100 * (row.figures.strength / still.figures.strength - 1), row.figures.strain_at_peak,
                 1e-9 * row.figures.young_modulus, row.steps, row.rate > 0 ? "steps" : "solutions", row.cost,
                 row.balance_error);
      std::fflush(stdout);
    }

    void write(const BenchResults &results, const std::vector<RateRow> &rows)
    {
      const RateRow &still = rows.front();
      std::string csv = "rate [1/s],strength [Pa],over_static [-],strain_at_peak [-],young_modulus [Pa],steps,cost [s],"
                        "balance_error [-]\n";
      std::string md =
        "| Rate [1/s] | Strength [MPa] | Over the static one | Strain at peak | E [GPa] | Steps | Cost [s] | "
        "Energy balance |\n|---|---|---|---|---|---|---|---|\n";
      for (const RateRow &r : rows)
        {
          const double ratio = r.figures.strength / still.figures.strength;
          csv += fmt::format("{},{},{},{},{},{},{},{}\n", r.rate, r.figures.strength, ratio, r.figures.strain_at_peak,
                             r.figures.young_modulus, r.steps, r.cost, r.balance_error);
          md +=
            fmt::format("| {} | {:.4f} | {:.4f} | {:.3e} | {:.3f} | {} | {:.2f} | {:.1e} |\n",
                        r.rate > 0 ? fmt::format("{}", r.rate) : "0 (quasi-static)", 1e-6 * r.figures.strength, ratio,
                        r.figures.strain_at_peak, 1e-9 * r.figures.young_modulus, r.steps, r.cost, r.balance_error);
        }
      results.write(csv, md);
    }

    std::vector<postprocess::PlotPanel> panels_of(const std::vector<RateRow> &rows)
    {
      postprocess::PlotPanel strength, cost;
      strength.title   = "strength over the rate";
      strength.x_label = "Strain rate [1/s]";
      strength.y_label = "Tensile strength [MPa]";
      strength.log_x   = true;
      cost.title       = "what it costs";
      cost.x_label     = "Processor time [s]";
      cost.y_label     = "Strength over the static one, less 1";
      cost.log_x = cost.log_y = true;
      postprocess::PlotSeries dynamic, still, excess;
      dynamic.name = "dynamic";
      still.name   = "quasi-static";
      still.style  = postprocess::PlotSeries::Style::line;
      for (const RateRow &r : rows)
        if (r.rate > 0)
          {
            dynamic.x.push_back(r.rate);
            dynamic.y.push_back(1e-6 * r.figures.strength);
            still.x.push_back(r.rate);
            still.y.push_back(1e-6 * rows.front().figures.strength);
            excess.x.push_back(r.cost);
            excess.y.push_back(std::fabs(r.figures.strength / rows.front().figures.strength - 1));
          }
      strength.series = {dynamic, still};
      cost.series     = {excess};
      return {strength, cost};
    }
  } // namespace

  int run_quasi_static_bench(const QuasiStaticBench &requested)
  {
    QuasiStaticBench bench = requested;
    if (bench.quick)
      {
        bench.cell_particles = 250;
        bench.edge           = 8;
        bench.rates          = {30, 3, 0.3};
      }
    const UniaxialModel model = model_of(read_scene(bench.scene, bench.overrides), bench);
    const BenchResults  results(bench.folder, "quasi_static");
    const dem::Packing  packing = make_packing(model.source, model.material, model.physics.dimension);
    fmt::print("{} particles\n", packing.size());

    std::vector<RateRow> rows = {follow(model, packing)};
    announce(rows.back(), rows.front());
    for (const double rate : bench.rates)
      {
        rows.push_back(pull(model, packing, rate));
        announce(rows.back(), rows.front());
      }
    write(results, rows);
    return results.finish(panels_of(rows));
  }
} // namespace apps
