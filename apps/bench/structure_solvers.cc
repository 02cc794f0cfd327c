#include "apps/bench/structure_solvers.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/structure/model.h"
#include "apps/runs/structure/promotion.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace apps
{
  namespace
  {
    /** What following the path by one solver gave. */
    struct Followed
    {
      std::size_t         particles = 0;
      int                 solutions = 0;
      double              cost      = 0; ///< processor time, packing and set-up left out [s]
      std::vector<double> forces;        ///< of the load factor, at each point [J]
    };

    Followed follow(const StructureBench &bench, const std::string &radius, const std::string &solver)
    {
      const SceneVariant variant{
        "solver",
        solver,
        {"Specimen/Generator/Particle radius=" + radius, "Path/End=5e-6", "Path/Linear solver=" + solver}};
      const CheckedScene          checked = variant.of(bench.scene, bench.overrides);
      const StructureModel       &model   = model_of_kind<StructureModel>(checked, "structure");
      std::optional<dem::Packing> cell;
      const dem::Packing          packing = model.packing(&cell);
      const ParticleMedia         media   = model.media(cell);
      Promotion                   promotion(model, packing, media);
      Structure                  &structure = promotion.structure();
      Followed                    found;
      const double                start = base::processor_seconds();
      while (!structure.finished())
        {
          structure.advance();
          const dem::QuasiStaticPoint &point = structure.last();
          found.solutions += point.iterations;
          found.forces.push_back(point.stress[structure.network().driven] * structure.network().volume);
        }
      found.cost      = base::processor_seconds() - start;
      found.particles = structure.network().network.particles();
      return found;
    }

    /** Over the largest force; infinite where one has other points. */
    double difference(const Followed &one, const Followed &other)
    {
      if (one.forces.size() != other.forces.size())
        return std::numeric_limits<double>::infinity();
      double largest = 0, apart = 0;
      for (std::size_t k = 0; k < one.forces.size(); ++k)
        {
          largest = std::max(largest, std::fabs(one.forces[k]));
          apart   = std::max(apart, std::fabs(one.forces[k] - other.forces[k]));
        }
      return apart / largest;
    }

    struct SolverRow
    {
      std::string radius;
      Followed    factor, iteration;
    };

    void write(const BenchResults &results, const std::vector<SolverRow> &rows)
    {
      std::string csv =
        "radius [m],particles,points,solutions by factors,solutions by iteration,cost by factors [s],cost "
        "by iteration [s],forces differ by [-]\n";
      std::string md = "| Radius [mm] | Particles | Points | Solutions, by factors and by iteration | By factors [s] | "
                       "By iteration [s] "
                       "| Times | Forces differ by |\n|---|---|---|---|---|---|---|---|\n";
      for (const auto &[radius, factor, iteration] : rows)
        {
          const double apart = difference(iteration, factor);
          csv += fmt::format("{},{},{},{},{},{},{},{}\n", radius, factor.particles, factor.forces.size(),
                             factor.solutions, iteration.solutions, factor.cost, iteration.cost, apart);
          md += fmt::format("| {:g} | {} | {} | {} and {} | {:.2f} | {:.2f} | {:.1f} | {:.0e} |\n",
                            1e3 * std::stod(radius), factor.particles, factor.forces.size(), factor.solutions,
                            iteration.solutions, factor.cost, iteration.cost, factor.cost / iteration.cost, apart);
        }
      results.write(csv, md);
    }

    postprocess::PlotPanel panel_of(const std::vector<SolverRow> &rows)
    {
      postprocess::PlotSeries factor, iteration;
      factor.name    = "by factors";
      iteration.name = "by iteration";
      for (const SolverRow &row : rows)
        for (auto *series : {&factor, &iteration})
          {
            series->x.push_back(static_cast<double>(row.factor.particles));
            series->y.push_back(series == &factor ? row.factor.cost : row.iteration.cost);
          }
      postprocess::PlotPanel panel;
      panel.title   = "the first equilibria of a beam with a core";
      panel.x_label = "Particles";
      panel.y_label = "Processor time [s]";
      panel.log_x = panel.log_y = true;
      panel.series              = {factor, iteration};
      return panel;
    }
  } // namespace

  int run_structure_solvers(const StructureBench &bench)
  {
    start_mpi();
    const BenchResults     results(bench.folder, "structure_solvers");
    std::vector<SolverRow> rows;
    for (const char *radius : {"0.001", "0.0005", "0.0003"})
      {
        rows.push_back({radius, follow(bench, radius, "direct"), follow(bench, radius, "iterative")});
        const SolverRow &row = rows.back();
        write(results, rows);
        fmt::print("{:5} particles, {:2} points: {:.2f} s by factors, {:.2f} s by iteration, forces differ by {:.0e}\n",
                   row.factor.particles, row.factor.forces.size(), row.factor.cost, row.iteration.cost,
                   difference(row.iteration, row.factor));
        std::fflush(stdout);
        if (bench.quick)
          break;
      }
    return results.finish({panel_of(rows)});
  }
} // namespace apps
