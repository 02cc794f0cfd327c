#include "apps/bench/multiscale.h"

#include "apps/bench/concrete_links.h"
#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/analysis.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/continuum/solid.h"
#include "apps/specimens/specimen_packing.h"
#include "base/stopwatch.h"
#include "coupling/multiscale/cell_points.h"
#include "coupling/multiscale/moving_cells.h"
#include "dem/laws/cpm.h"
#include "dem/packing/compaction.h"

#include <fmt/format.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace apps
{
  namespace
  {
    /** A scene that is varied, and where its load is read. */
    struct Benched
    {
      std::string              scene;
      std::vector<std::string> overrides;
      std::string              force; ///< column of series.csv
    };

    /** Curve of a structure, and what it has cost. */
    struct CellRow
    {
      std::string         study, value;
      double              promoted = 0, points = 0; ///< at the end, of all
      std::vector<double> abscissa, force;          ///< part of the way that is done, reaction [N]
      double              cost = 0;                 ///< processor time, packings and set-up left out [s]
    };

    std::size_t column_named(const ContinuumProbes<2> &probes, const std::string &name)
    {
      const auto columns = probes.columns();
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].column.name == name)
          return c;
      throw base::InputError(
        "this bench needs a column " + name +
        " of series.csv: a support \"load\" that is driven along y (of the plate a boundary \"right\", "
        "along x), and a group of cells.");
    }

    const ContinuumModel &plane_model(const CheckedScene &checked)
    {
      const ContinuumModel &model = model_of_kind<ContinuumModel>(checked, "continuum");
      if (model.solid.dimension != 2)
        refuse_scene(checked, "Model: must be plane.");
      return model;
    }

    CellRow follow(const SceneVariant &variant, const Benched &of)
    {
      const CheckedScene    checked = variant.of(of.scene, of.overrides);
      const ContinuumModel &model   = plane_model(checked);
      const auto            solid   = make_solid<2>(model);
      const auto            analysis =
        model.is_static() ? make_static_analysis<2>(*solid, model) : make_explicit_analysis<2>(*solid, model);
      const ContinuumProbes<2> probes(*solid, model);
      const std::size_t        load = column_named(probes, of.force);
      CellRow                  row{variant.study, variant.value, 0, 0, {}, {}, 0};
      row.points =
        static_cast<double>(solid->mesh().triangulation->n_global_active_cells() * solid->quadrature().size());
      const double start = base::processor_seconds();
      try
        {
          while (!analysis->finished() && solid->end_of_validity().empty())
            {
              while (!analysis->advance())
                continue;
              ContinuumEnergy energy = analysis->energy();
              const auto      values = probes.read(analysis->state(), energy);
              row.abscissa.push_back(analysis->coordinate() / analysis->end());
              row.force.push_back(std::fabs(values[load]));
              row.promoted = model.is_static() ? values[column_named(probes, "points_promoted")] : row.points;
            }
        }
      catch (const fem::NoEquilibrium &end)
        {
          fmt::print("  {} {}: {}\n", row.study, row.value, end.what());
        }
      row.cost = base::processor_seconds() - start;
      return row;
    }

    /** Force of a curve where another one has a point, between two of its own. */
    double force_at(const CellRow &row, const double x)
    {
      const auto above = std::lower_bound(row.abscissa.begin(), row.abscissa.end(), x);
      const auto i     = static_cast<std::size_t>(above - row.abscissa.begin());
      if (i == 0)
        return row.force.front() * x / row.abscissa.front();
      const double part = (x - row.abscissa[i - 1]) / (row.abscissa[i] - row.abscissa[i - 1]);
      return row.force[i - 1] + part * (row.force[i] - row.force[i - 1]);
    }

    /** Largest difference of the curves as far as both go, over the peak of the reference. */
    double error_of(const CellRow &row, const CellRow &reference)
    {
      double       worst = 0;
      const double peak  = *std::max_element(reference.force.begin(), reference.force.end());
      for (std::size_t i = 0; i < reference.abscissa.size(); ++i)
        if (reference.abscissa[i] <= row.abscissa.back())
          worst = std::max(worst, std::fabs(force_at(row, reference.abscissa[i]) - reference.force[i]) / peak);
      return worst;
    }

    /** Cells where they are needed against cells everywhere; the first is the reference. */
    std::vector<SceneVariant> promotions()
    {
      const std::string cells = "Materials/solid/cells/";
      return {
        {"cells everywhere", "all solved for", {cells + "From the start=true", cells + "Elastic by solving=true"}},
        {"cells everywhere", "elastic known", {cells + "From the start=true"}},
        {"promotion", "0.9", {}}};
    }

    std::vector<SceneVariant> cell_variants()
    {
      const std::string         cells = "Materials/solid/cells/";
      std::vector<SceneVariant> all   = promotions();
      all.push_back({"promotion", "0.5", {cells + "Promotion=0.5"}});
      all.push_back({"promotion", "1", {cells + "Promotion=1"}});
      all.push_back({"tolerance", "1e-6", {cells + "Tolerance=1e-6"}});
      all.push_back({"tolerance", "1e-4", {cells + "Tolerance=1e-4"}});
      for (const int n : {32, 100}) // cells of the same size, of finer or coarser particles
        all.push_back(
          {"particles",
           std::to_string(n),
           {cells + "Specimen/Generator/Cell particles=" + std::to_string(n),
            cells + fmt::format("Specimen/Generator/Particle radius={:.6g}", 0.0012 * std::cbrt(64.0 / n))}});
      return all;
    }

    /** The beam, driven so far. */
    Benched beam(const MultiscaleBench &bench, std::vector<std::string> how)
    {
      how.insert(how.end(), bench.overrides.begin(), bench.overrides.end());
      return {bench.scene, how, "reaction_load_y"};
    }

    Benched beam_before_peak(const MultiscaleBench &bench)
    {
      return beam(bench, {bench.quick ? "Control/End=6e-6" : "Control/End=1.6e-5"});
    }

    Benched beam_past_peak(const MultiscaleBench &bench)
    {
      return beam(bench, {"Materials/solid/cells/Material/CPM/Relative ductility=50", "Control/First step=1e-6",
                          "Control/Largest step=1e-6", "Control/End=8.2e-5"});
    }

    /** A small plate, pulled in equilibrium, and in motion within so many milliseconds. */
    Benched small_plate(const std::string &scene)
    {
      const std::string mesh = "Mesh/Plate with hole/";
      return {scene,
              {mesh + "Radial divisions=4", mesh + "Angular divisions=4",
               "Materials/solid/cells/Specimen/Generator/Cell particles=32",
               "Materials/solid/cells/When localised=go on"},
              "reaction_right_x"};
    }

    SceneVariant pulled_in_motion(const double milliseconds, const double density)
    {
      const std::string cells = "Materials/solid/cells/";
      return {"in motion",
              fmt::format("{:g} ms with particles of {:g} kg/m^3", milliseconds, density),
              {"Model/Analysis=explicit", "Materials/solid/Density=2400", cells + "Answer=motion",
               cells + fmt::format("Particle density={:g}", density), "Motion/Damping=1e4",
               fmt::format("Motion/End time={:g}", 1e-3 * milliseconds), "Output/Samples=200",
               fmt::format("Boundary conditions/right/Displacement x=2e-5*t/{:g}", 1e-3 * milliseconds)}};
    }

    std::vector<SceneVariant> driven_variants(const bool quick)
    {
      std::vector<SceneVariant> all = {
        {"in equilibrium", "40 steps", {}},
        {"in equilibrium", "10 steps", {"Control/First step=0.2", "Control/Largest step=0.2"}}};
      if (quick)
        return {all[1], pulled_in_motion(0.1, 3800), pulled_in_motion(0.5, 3800)};
      for (const double milliseconds : {0.25, 0.5, 1.0, 2.0})
        all.push_back(pulled_in_motion(milliseconds, 3800));
      all.push_back(pulled_in_motion(1, 16 * 3800)); // fewer steps of heavier particles
      return all;
    }

    /** What cells alone cost. */
    struct AloneRow
    {
      std::size_t particles = 0, links = 0;
      double      bound = 0, visited = 0;    ///< of an elastic point: by the bound, by visiting all links [s]
      double      elastic = 0, damaging = 0; ///< of a promoted cell: an increment [s]
      double      sixteen[2] = {0, 0};       ///< of so many damaging cells, by one thread and by two [s]
    };

    /** A cell in motion that is driven to a damaging strain in so many steps, against the static answer there. */
    struct MovingRow
    {
      std::int64_t steps   = 0;
      double       error   = 0; ///< of the stress, over it
      double       seconds = 0, of_static = 0;
    };

    double seconds_of(const std::function<void()> &work, const int times)
    {
      work();
      const base::Stopwatch watch;
      for (int i = 0; i < times; ++i)
        work();
      return watch.seconds() / times;
    }

    dem::Packing packing_of(const std::size_t particles)
    {
      dem::CompactionParameters packing;
      packing.radius = 1e-3;
      packing.count  = particles;
      return compact_with_progress(packing).packing;
    }

    base::Voigt pulled(const double size) { return (base::Voigt() << 1, -0.2, -0.2, 0, 0, 0).finished() * size; }

    std::vector<MovingRow> in_motion(const std::size_t particles)
    {
      coupling::CellParameters cell;
      cell.links.interaction_ratio = 1.5;
      const dem::Packing packed    = packing_of(particles);
      const auto         prepared  = std::make_shared<coupling::PreparedCell>(packed, concrete_links(), cell);
      double             size      = 1e-7;
      while (!prepared->is_left_by(pulled(size)))
        size *= 1.02;
      const base::Voigt    end = pulled(1.5 * size);
      coupling::CellPoints still({{prepared}, coupling::Localised::go_on}, fem::Plane::strain);
      fem::PointAnswer     reference;
      still.allocate(1);
      const base::Stopwatch clock;
      for (const double part : {0.6, 0.8, 1.0})
        {
          still.evaluate(0, part * end, {}, true, reference);
          still.commit();
        }
      const double           of_static = clock.seconds();
      std::vector<MovingRow> rows;
      for (const std::int64_t steps : {300, 1000, 3000, 10000})
        {
          coupling::MovingCellsParameters p{{packed}, concrete_links(), {}, steps, prepared->stiffness()};
          p.specimen.density           = 2400;
          p.specimen.damping           = 0.2;
          p.specimen.interaction_ratio = 1.5;
          coupling::MovingCells of(p, fem::Plane::strain);
          of.allocate(1);
          of.place(std::vector<fem::GatheredPoints::Site>(1), {});
          const base::Stopwatch watch;
          of.begin_motion(static_cast<double>(steps) * 0.4 * 1e-3 * std::sqrt(2400 / 25e9));
          of.gather({end}, false);
          const double     seconds = watch.seconds();
          fem::PointAnswer answer;
          of.evaluate(0, end, {}, false, answer);
          rows.push_back(
            {steps, (answer.stress - reference.stress).norm() / reference.stress.norm(), seconds, of_static});
        }
      return rows;
    }

    std::string table_of(const std::vector<MovingRow> &rows)
    {
      std::string md = "| A cell in motion, steps of its particles | Error of the stress | Cost [ms] | Static, three "
                       "increments [ms] |\n|---|---|---|---|\n";
      for (const MovingRow &r : rows)
        md += fmt::format("| {} | {:.2f} % | {:.0f} | {:.0f} |\n", r.steps, 100 * r.error, 1e3 * r.seconds,
                          1e3 * r.of_static);
      return md + "\n";
    }

    AloneRow alone(const std::size_t particles)
    {
      const dem::CpmParameters law = concrete_links();
      coupling::CellParameters cell;
      cell.links.interaction_ratio = 1.5;
      cell.from_start              = true;
      const dem::Packing packed    = packing_of(particles);
      const auto         promoted  = std::make_shared<coupling::PreparedCell>(packed, law, cell);
      cell.from_start              = false;
      const auto elastic           = std::make_shared<coupling::PreparedCell>(packed, law, cell);

      AloneRow          row{elastic->particles(), elastic->links()};
      const base::Voigt unit = pulled(1);
      double            sum = 0, size = 1e-7;
      row.bound   = seconds_of([&] { sum += elastic->elastic_range()->surely_below(size * unit) ? 1 : 0; }, 1000);
      row.visited = seconds_of([&] { sum += elastic->elastic_range()->nearest(size * unit).exertion; }, 20);
      while (!elastic->is_left_by(size * unit))
        size *= 1.02;
      const auto measured = [&](const std::size_t n, const double strain, const int threads) {
        coupling::CellPoints points({{promoted}, coupling::Localised::go_on}, fem::Plane::strain);
        points.allocate(n);
        omp_set_num_threads(threads);
        const auto gather = [&](const double to) {
          points.gather(std::vector<base::Voigt>(n, to * unit), true);
          points.commit();
        };
        gather(0.9 * size);
        gather(strain > size ? 1.1 * size : 0.95 * size);
        const base::Stopwatch watch;
        gather(strain);
        omp_set_num_threads(1);
        return watch.seconds();
      };
      row.elastic  = std::min(measured(1, size, 1), measured(1, size, 1));
      row.damaging = measured(1, 1.2 * size, 1);
      for (const int threads : {1, 2})
        row.sixteen[threads - 1] = measured(16, 1.2 * size, threads);
      return row;
    }

    std::string table_of(const std::vector<AloneRow> &rows)
    {
      std::string md = "| Particles | Links | Elastic point, by the bound [us] | by visiting [us] | Promoted, elastic "
                       "increment [ms] | "
                       "damaging [ms] | 16 damaging, 1 thread [s] | 2 threads [s] | Speed-up "
                       "|\n|---|---|---|---|---|---|---|---|---|\n";
      for (const AloneRow &r : rows)
        md += fmt::format("| {} | {} | {:.2f} | {:.0f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} | {:.2f} |\n", r.particles,
                          r.links, 1e6 * r.bound, 1e6 * r.visited, 1e3 * r.elastic, 1e3 * r.damaging, r.sixteen[0],
                          r.sixteen[1], r.sixteen[0] / r.sixteen[1]);
      return md + "\n";
    }

    std::string table_of(const std::vector<CellRow> &rows)
    {
      std::string md = "| Study | | Promoted | of | Peak [N] | Error of the curve | Cost [s] | Cheaper "
                       "|\n|---|---|---|---|---|---|---|---|\n";
      for (const CellRow &r : rows)
        md += fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.2f} | {:.3f} % | {:.1f} | {:.2g} |\n", r.study, r.value,
                          r.promoted, r.points, *std::max_element(r.force.begin(), r.force.end()),
                          100 * error_of(r, rows.front()), r.cost, rows.front().cost / r.cost);
      return md + "\n";
    }

    /** @param tables of what stands before these rows */
    void write(const BenchResults &results, const std::string &tables, const std::vector<std::vector<CellRow>> &studies)
    {
      std::string csv = "study,value,promoted,points,peak [N],error_of_curve [-],cost [s]\n", md = tables;
      for (const std::vector<CellRow> &rows : studies)
        {
          for (const CellRow &r : rows)
            csv += fmt::format("{},{},{},{},{},{},{}\n", r.study, r.value, r.promoted, r.points,
                               *std::max_element(r.force.begin(), r.force.end()), error_of(r, rows.front()), r.cost);
          md += table_of(rows);
        }
      results.write(csv, md);
    }

    postprocess::PlotPanel cost_panel(const std::vector<CellRow> &rows, const std::string &title)
    {
      std::vector<CostPoint> points;
      for (const CellRow &row : rows)
        points.push_back({row.study, row.cost, std::max(1e-12, error_of(row, rows.front()))});
      return error_over_cost(title, "Cost over theirs", points);
    }
  } // namespace

  int run_multiscale_bench(const MultiscaleBench &bench)
  {
    const int threads = omp_get_max_threads(); // cells alone run with numbers of threads of their own
    start_mpi();
    for (const Benched &of : {beam_before_peak(bench), small_plate(bench.plate)}) // before anything that takes long
      plane_model(SceneVariant().of(of.scene, of.overrides));
    const BenchResults                results(bench.folder, "multiscale");
    std::vector<AloneRow>             cells;
    std::vector<std::vector<CellRow>> studies;
    for (const std::size_t particles :
         bench.quick ? std::vector<std::size_t>{64} : std::vector<std::size_t>{64, 250, 1000})
      {
        cells.push_back(alone(particles));
        fmt::print("{}", table_of({cells.back()}));
        std::fflush(stdout);
      }
    const std::vector<MovingRow> moving = in_motion(bench.quick ? 64 : 250);
    const std::string            tables = table_of(cells) + table_of(moving);
    fmt::print("{}", table_of(moving));
    std::fflush(stdout);
    omp_set_num_threads(threads);
    const auto study = [&](const std::vector<SceneVariant> &variants, const Benched &of) {
      studies.emplace_back();
      for (const SceneVariant &variant : variants)
        {
          std::vector<CellRow> &rows = studies.back();
          rows.push_back(follow(variant, of));
          write(results, tables, studies);
          const CellRow &row = rows.back();
          fmt::print(
            "{:<17} {:<15} {:.0f} of {:.0f} promoted, error of the curve {:.3f} %, {:.1f} s ({:.1f} times cheaper)\n",
            row.study, row.value, row.promoted, row.points, 100 * error_of(row, rows.front()), row.cost,
            rows.front().cost / row.cost);
          std::fflush(stdout);
        }
    };
    study(promotions(), beam_before_peak(bench));
    if (!bench.quick)
      study(cell_variants(), beam_past_peak(bench));
    study(driven_variants(bench.quick), small_plate(bench.plate));
    return results.finish({cost_panel(studies.end()[-2], "curve against that of cells everywhere"),
                           cost_panel(studies.back(), "cells in motion against cells in equilibrium")});
  }
} // namespace apps
