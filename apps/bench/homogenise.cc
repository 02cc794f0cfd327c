#include "apps/bench/homogenise.h"

#include "apps/bench/results.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/statistics/sample.h"
#include "base/stopwatch.h"
#include "base/voigt.h"
#include "dem/homogenisation/isotropy.h"
#include "dem/homogenisation/relaxed_stiffness.h"
#include "dem/laws/elastic_links.h"
#include "dem/linear/dynamic_relaxation.h"
#include "dem/loading/periodic_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace apps
{
  namespace
  {
    struct ModuliRow
    {
      std::string study, solver;
      std::size_t particles = 0, links = 0;
      double      tolerance = 0, residual = 0;
      int         iterations = 0;
      double      cost       = 0; ///< [s], processor time
      double      error      = 0; ///< relative, of the stiffness; in the study of seeds of the modulus
    };

    dem::Packing packing(const HomogeniseBench &bench, const int particles, const int seed)
    {
      dem::CompactionParameters make;
      make.radius   = 1e-3;
      make.count    = static_cast<std::size_t>(particles);
      make.seed     = static_cast<std::uint64_t>(seed);
      make.friction = bench.friction;
      return compact_with_progress(make).packing;
    }

    dem::ElasticNetwork network_of(const dem::Packing &packing, const HomogeniseBench &bench)
    {
      dem::NetworkParameters links;
      links.interaction_ratio = bench.interaction_ratio;
      links.shear_ratio       = bench.shear_ratio;
      links.normal_modulus    = 1;
      return dem::make_network(packing, links);
    }

    double difference(const dem::MacroscopicStiffness &a, const dem::MacroscopicStiffness &exact)
    {
      return (a - exact).norm() / exact.norm();
    }

    ModuliRow solve(const dem::ElasticNetwork &network,
                    const dem::SolverMethod    method,
                    const double               tolerance,
                    dem::MacroscopicStiffness &stiffness)
    {
      dem::SolverParameters solver;
      solver.method        = method;
      solver.tolerance     = tolerance;
      const double start   = base::processor_seconds();
      const auto   relaxed = dem::relaxed_stiffness(network, solver);
      ModuliRow    row;
      row.cost       = base::processor_seconds() - start;
      row.iterations = relaxed.solver.iterations;
      row.residual   = relaxed.solver.residual;
      stiffness      = relaxed.stiffness;
      return row;
    }

    /** The six load cases shaken to rest; the stiffness from the mean stress of the links, as a particle code would. */
    ModuliRow relax(const dem::ElasticNetwork &network, const double tolerance, dem::MacroscopicStiffness &stiffness)
    {
      const double                 start = base::processor_seconds();
      const dem::StiffnessOperator K(network, {});
      dem::LaneStrains             strain;
      for (int lane = 0; lane < dem::load_lanes; ++lane)
        strain[lane] =
          lane < dem::first_probe ? base::Vector6(base::Vector6::Unit(lane)) : base::Vector6(base::Vector6::Zero());
      dem::Fields x(network.particles() * dem::motions * dem::load_lanes, 0.0), b(x.size());
      K.apply(x, strain, b);
      for (double &value : b)
        value = -value;
      dem::DynamicRelaxationParameters parameters;
      parameters.limits.tolerance      = tolerance;
      parameters.limits.max_iterations = 100000;
      const auto report =
        dem::relax_dynamically(K, b, x, K.link_force_norm(dem::Fields(x.size(), 0.0), strain), parameters);
      stiffness = K.energy_product(x, strain) / network.volume;
      ModuliRow row;
      row.cost       = base::processor_seconds() - start;
      row.iterations = report.iterations;
      row.residual   = report.largest_residual();
      return row;
    }

    /**
     * The specimen of a particle code: strained by 1e-6 within ten steps in each of the six ways, and then damped to rest. Links
     * neither damage nor slide. Its kinematics are finite: the odd part of both signs would be free of that to first order, but
     * costs twice; at this strain it is 1e-6 of the stress.
     */
    ModuliRow shake(const dem::Packing        &packing,
                    const HomogeniseBench     &bench,
                    const double               tolerance,
                    dem::MacroscopicStiffness &stiffness)
    {
      constexpr double        strain = 1e-6;
      dem::SpecimenParameters s;
      s.physics.periodic = true;
      s.physics.damage = s.physics.friction = s.physics.contacts = false;
      s.density                                                  = 4800;
      s.interaction_ratio                                        = bench.interaction_ratio;
      s.damping                                                  = 0.2;
      const dem::LinkMaterials links                             = dem::elastic_links(1, bench.shear_ratio);
      ModuliRow                row;
      const double             start = base::processor_seconds();
      for (int c = 0; c < 6; ++c)
        {
          dem::Specimen           body(packing, s, links);
          dem::CellTestParameters test;
          test.path.resize(1);
          test.path[0].duration  = 10 * body.time_step();
          test.path[0].target[c] = strain;
          dem::CellTest(body, test).advance(10);
          body.set_velocity_gradient(Eigen::Matrix3d::Zero());
          constexpr std::int64_t between_looks = 20, most = 200000;
          do
            body.advance(between_looks);
          while (body.unbalanced_ratio() > tolerance && body.steps() < most);
          row.iterations += static_cast<int>(body.steps());
          row.residual     = std::max(row.residual, body.unbalanced_ratio());
          stiffness.col(c) = base::stress_voigt(body.cell().stress) / strain;
        }
      row.cost = base::processor_seconds() - start;
      return row;
    }

    void announce(const ModuliRow &row)
    {
      fmt::print("{:<8} {:>6} particles  {:<10} tolerance {:.0e}  {:>6} iterations  {:>9.4f} s  error {:.2e}\n",
                 row.study, row.particles, row.solver, row.tolerance, row.iterations, row.cost, row.error);
      std::fflush(stdout);
    }

    void study_solvers(const HomogeniseBench &bench, std::vector<ModuliRow> &rows)
    {
      for (const int particles : bench.particles)
        {
          const dem::Packing        spheres = packing(bench, particles, 1);
          const dem::ElasticNetwork network = network_of(spheres, bench);
          dem::MacroscopicStiffness exact, stiffness;
          solve(network, dem::SolverMethod::direct, 1e-13, exact);
          const auto add = [&](ModuliRow row, const char *solver, const double tolerance) {
            row.study     = "solver";
            row.solver    = solver;
            row.tolerance = tolerance;
            row.particles = network.particles();
            row.links     = network.links.size();
            row.error     = difference(stiffness, exact);
            announce(row);
            rows.push_back(row);
          };
          add(solve(network, dem::SolverMethod::direct, 1e-10, stiffness), "direct", 1e-10);
          for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10})
            add(solve(network, dem::SolverMethod::iterative, tolerance, stiffness), "iterative", tolerance);
          for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6})
            add(relax(network, tolerance, stiffness), "dynamic", tolerance);
          for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6})
            add(shake(spheres, bench, tolerance, stiffness), "specimen", tolerance);
        }
    }

    void study_seeds(const HomogeniseBench &bench, std::vector<ModuliRow> &rows)
    {
      for (const int particles : bench.seed_particles)
        {
          std::vector<double> young;
          ModuliRow           row;
          row.study     = "seeds";
          row.solver    = "iterative";
          row.tolerance = 1e-10;
          for (int seed = 1; seed <= bench.seeds; ++seed)
            {
              const dem::ElasticNetwork network = network_of(packing(bench, particles, seed), bench);
              dem::MacroscopicStiffness stiffness;
              const ModuliRow           one = solve(network, dem::SolverMethod::iterative, 1e-10, stiffness);
              row.cost += one.cost / bench.seeds;
              row.iterations = one.iterations;
              row.residual   = std::max(row.residual, one.residual);
              row.particles  = network.particles();
              row.links      = network.links.size();
              young.push_back(dem::isotropy_measures(stiffness, 3).mean.young);
            }
          const statistics::SampleMoments sample = statistics::moments_of(young);
          row.error                              = sample.deviation / sample.mean;
          announce(row);
          rows.push_back(row);
        }
    }

    void write(const BenchResults &results, const std::vector<ModuliRow> &rows)
    {
      std::string csv = "study,solver,particles,links,tolerance,iterations,residual,cost [s],error [-]\n";
      std::string md = "| Study | Solver | Particles | Links | Tolerance | Iterations | Residual | Cost [s] | Error |\n"
                       "|---|---|---|---|---|---|---|---|---|\n";
      for (const ModuliRow &r : rows)
        {
          csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.study, r.solver, r.particles, r.links, r.tolerance,
                             r.iterations, r.residual, r.cost, r.error);
          md += fmt::format("| {} | {} | {} | {} | {:.0e} | {} | {:.1e} | {:.4f} | {:.2e} |\n", r.study, r.solver,
                            r.particles, r.links, r.tolerance, r.iterations, r.residual, r.cost, r.error);
        }
      results.write(csv, md);
    }

    /** The scatter over seeds of cells as large, as a level: a tighter solution than that is no better for the material. */
    void add_scatter(postprocess::PlotPanel &panel, const std::size_t particles, const std::vector<ModuliRow> &rows)
    {
      const ModuliRow *of_seeds = nullptr;
      for (const ModuliRow &r : rows)
        if (r.study == "seeds" && r.particles <= particles && (!of_seeds || r.particles > of_seeds->particles))
          of_seeds = &r;
      if (!of_seeds)
        return;
      postprocess::PlotSeries level;
      // Scatter falls as the root of the number of spheres (doc/theory/homogenisation.md).
      const double scatter =
        of_seeds->error * std::sqrt(static_cast<double>(of_seeds->particles) / static_cast<double>(particles));
      level.name  = "scatter of such cells";
      level.style = postprocess::PlotSeries::Style::line;
      for (const postprocess::PlotSeries &s : panel.series)
        for (const double x : s.x)
          level.x.push_back(x);
      std::sort(level.x.begin(), level.x.end());
      level.y.assign(level.x.size(), scatter);
      panel.series.push_back(level);
    }

    /** A panel per size of cell: error over cost of each solver, and the scatter of such cells as a level to stay below. */
    std::vector<postprocess::PlotPanel> panels_of(const HomogeniseBench &bench, const std::vector<ModuliRow> &rows)
    {
      std::vector<postprocess::PlotPanel> panels;
      const auto                          panel_of = [](const std::string &title, const std::string &y) {
        postprocess::PlotPanel panel;
        panel.title   = title;
        panel.x_label = "Processor time of six load cases [s]";
        panel.y_label = y;
        panel.log_x = panel.log_y = true;
        return panel;
      };
      for (const int particles : bench.particles)
        {
          postprocess::PlotPanel panel =
            panel_of(fmt::format("{} spheres", particles), "Relative error of the stiffness");
          for (const char *solver : {"direct", "iterative", "dynamic", "specimen"})
            {
              postprocess::PlotSeries series;
              series.name = solver;
              for (const ModuliRow &r : rows)
                if (r.study == "solver" && r.solver == solver && r.particles == static_cast<std::size_t>(particles))
                  {
                    series.x.push_back(r.cost);
                    series.y.push_back(std::max(r.error, 1e-16));
                  }
              panel.series.push_back(series);
            }
          add_scatter(panel, static_cast<std::size_t>(particles), rows);
          panels.push_back(panel);
        }
      postprocess::PlotPanel  scatter = panel_of("one cell for the material", "Standard deviation of E over seeds");
      postprocess::PlotSeries series;
      for (const ModuliRow &r : rows)
        if (r.study == "seeds")
          {
            series.x.push_back(r.cost);
            series.y.push_back(r.error);
          }
      scatter.series.push_back(series);
      panels.push_back(scatter);
      return panels;
    }
  } // namespace

  int run_homogenise_bench(const HomogeniseBench &requested)
  {
    HomogeniseBench bench = requested;
    if (bench.quick)
      {
        bench.particles      = {64, 125};
        bench.seed_particles = {64, 125};
        bench.seeds          = 3;
      }
    const BenchResults     results(bench.folder, "homogenise");
    std::vector<ModuliRow> rows;
    study_solvers(bench, rows);
    study_seeds(bench, rows);
    write(results, rows);
    return results.finish(panels_of(bench, rows));
  }
} // namespace apps
