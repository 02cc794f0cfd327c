#include "apps/bench/quasi_static.h"

#include "apps/drivers/parts/specimen_packing.h"
#include "apps/process/exit_status.h"
#include "dem/laws/cpm.h"
#include "dem/loading/uniaxial.h"
#include "dem/statics/quasi_static_path.h"
#include "postprocess/atomic_file.h"
#include "postprocess/errors.h"
#include "postprocess/plot.h"

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <limits>
#include <string>

namespace apps
{
  namespace
  {
    constexpr double radius = 1e-3, interaction_ratio = 1.5;

    struct Row
    {
      double       rate     = 0; ///< [1/s]; 0: quasi-static
      double       strength = 0, strain_at_peak = 0, young_modulus = 0;
      double       balance_error = 0;
      std::int64_t steps         = 0; ///< time steps, or linear solutions
      double       cost          = 0; ///< processor time [s]
    };

    dem::GripParameters grips_of_the_bench()
    {
      dem::GripParameters p;
      p.thickness = 2.2 * radius;
      return p;
    }

    double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

    dem::CpmParameters concrete()
    {
      dem::CpmParameters law;
      law.normal_modulus       = 25e9;
      law.shear_ratio          = 0.2;
      law.limit_elastic_strain = 1e-4;
      law.relative_ductility   = 30;
      law.cohesion             = 3e6;
      law.friction_coefficient = 0.8;
      return law;
    }

    Row follow(const dem::Packing &packing)
    {
      const dem::CpmParameters law = concrete();
      dem::NetworkParameters   links;
      links.interaction_ratio = interaction_ratio;
      links.normal_modulus    = law.normal_modulus;
      links.shear_ratio       = law.shear_ratio;
      dem::GripPair grips;
      grips.layers      = dem::find_grip_layers({packing.centre, packing.radius}, 2, grips_of_the_bench());
      const auto loaded = dem::load_grips(dem::make_network(packing, links), grips);

      dem::QuasiStaticParameters p;
      p.strain_step              = 5e-6;
      p.end_strain               = 1e-3;
      p.end_stress               = 0.8;
      const double         start = processor_seconds();
      dem::QuasiStaticPath path(loaded, law, p);
      Row                  row;
      while (!path.finished())
        {
          const dem::QuasiStaticPoint &point = path.advance();
          row.steps += point.iterations;
          row.balance_error = std::max(row.balance_error, point.balance_error());
          if (path.points().size() == 2)
            row.young_modulus = point.stress[0] / point.strain[0];
          if (point.stress[0] > row.strength)
            {
              row.strength       = point.stress[0];
              row.strain_at_peak = point.strain[0];
            }
        }
      row.cost = processor_seconds() - start;
      return row;
    }

    Row pull(const dem::Packing &packing, const double rate, const double damping)
    {
      dem::SpecimenParameters s;
      s.density           = 4800;
      s.interaction_ratio = interaction_ratio;
      s.damping           = damping;
      dem::UniaxialParameters u;
      u.strain_rate           = rate;
      u.grips                 = grips_of_the_bench();
      u.stop_fraction         = 0.8;
      u.stop_strain           = 1e-3;
      const double      start = processor_seconds();
      dem::Specimen     body(packing, s, concrete());
      dem::UniaxialTest test(body, u);
      Row               row;
      row.rate = rate;
      while (!test.finished())
        {
          test.advance(std::max<std::int64_t>(1, static_cast<std::int64_t>(1e-7 / (rate * body.time_step()))));
          row.balance_error = std::max(row.balance_error, body.energy().balance_error());
        }
      const dem::UniaxialFigures figures = test.figures();
      row.strength                       = figures.strength;
      row.strain_at_peak                 = figures.strain_at_peak;
      row.young_modulus                  = figures.young_modulus;
      row.steps                          = body.steps();
      row.cost                           = processor_seconds() - start;
      return row;
    }

    void announce(const Row &row, const Row &still)
    {
      fmt::print("{:<22} strength {:.4f} MPa ({:+.2f} %) at {:.3e}, E {:.3f} GPa, {} {}, {:.2f} s, balance {:.1e}\n",
                 row.rate > 0 ? fmt::format("dynamic, {} 1/s", row.rate) : "quasi-static", 1e-6 * row.strength,
                 100 * (row.strength / still.strength - 1), row.strain_at_peak, 1e-9 * row.young_modulus, row.steps,
                 row.rate > 0 ? "steps" : "solutions", row.cost, row.balance_error);
      std::fflush(stdout);
    }

    void write(const std::filesystem::path &folder, const std::vector<Row> &rows)
    {
      const Row  &still = rows.front();
      std::string csv = "rate [1/s],strength [Pa],over_static [-],strain_at_peak [-],young_modulus [Pa],steps,cost [s],"
                        "balance_error [-]\n";
      std::string md =
        "| Rate [1/s] | Strength [MPa] | Over the static one | Strain at peak | E [GPa] | Steps | Cost [s] | "
        "Energy balance |\n|---|---|---|---|---|---|---|---|\n";
      for (const Row &r : rows)
        {
          const double ratio = r.strength / still.strength;
          csv += fmt::format("{},{},{},{},{},{},{},{}\n", r.rate, r.strength, ratio, r.strain_at_peak, r.young_modulus,
                             r.steps, r.cost, r.balance_error);
          md += fmt::format("| {} | {:.4f} | {:.4f} | {:.3e} | {:.3f} | {} | {:.2f} | {:.1e} |\n",
                            r.rate > 0 ? fmt::format("{}", r.rate) : "0 (quasi-static)", 1e-6 * r.strength, ratio,
                            r.strain_at_peak, 1e-9 * r.young_modulus, r.steps, r.cost, r.balance_error);
        }
      postprocess::write_text(folder / "quasi_static.csv", csv);
      postprocess::write_text(folder / "quasi_static.md", md);
    }

    std::string draw(const std::filesystem::path &file, const std::vector<Row> &rows)
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
      for (const Row &r : rows)
        if (r.rate > 0)
          {
            dynamic.x.push_back(r.rate);
            dynamic.y.push_back(1e-6 * r.strength);
            still.x.push_back(r.rate);
            still.y.push_back(1e-6 * rows.front().strength);
            excess.x.push_back(r.cost);
            excess.y.push_back(std::fabs(r.strength / rows.front().strength - 1));
          }
      strength.series = {dynamic, still};
      cost.series     = {excess};
      return postprocess::plot(file, {strength, cost});
    }
  } // namespace

  int run_quasi_static_bench(const QuasiStaticBench &asked)
  {
    QuasiStaticBench bench = asked;
    if (bench.quick)
      {
        bench.cell_particles = 250;
        bench.edge           = 0.008;
        bench.rates          = {30, 3, 0.3};
      }
    std::error_code error;
    std::filesystem::create_directories(bench.folder, error);
    if (error)
      throw postprocess::OutputError(bench.folder.string() + ": cannot be made: " + error.message() + ".");
    dem::CompactionParameters make;
    make.radius          = radius;
    make.count           = static_cast<std::size_t>(bench.cell_particles);
    dem::Packing packing = cropped(compact_with_progress(make).packing, {bench.edge, bench.edge, 1.5 * bench.edge});
    packing.periodic_cell.reset();
    fmt::print("{} particles\n", packing.size());

    std::vector<Row> rows = {follow(packing)};
    announce(rows.back(), rows.front());
    for (const double rate : bench.rates)
      {
        rows.push_back(pull(packing, rate, bench.damping));
        announce(rows.back(), rows.front());
      }
    write(bench.folder, rows);
    const std::string problem = draw(bench.folder / "quasi_static.png", rows);
    if (!problem.empty())
      fmt::print(stderr, "no picture: {}\n", problem);
    fmt::print("written to {}\n", bench.folder.string());
    return exit_success;
  }
} // namespace apps
