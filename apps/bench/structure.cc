#include "apps/bench/structure.h"

#include "apps/bench/results.h"
#include "apps/bench/scene_variant.h"
#include "apps/process/mpi_session.h"
#include "apps/runs/structure/model.h"
#include "apps/runs/structure/promotion.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <cstdio>

namespace apps
{
  namespace
  {
    /** What a beam bears, and what following it there has cost. */
    struct BeamRow
    {
      std::string study, value;
      std::size_t particles = 0, points = 0;
      double      peak = 0, opening = 0; ///< [N], at the peak [m]
      double      damaged = 0;           ///< of the overlap's bonds, at the end
      double      balance = 0;           ///< of energies, at the end
      double      cost    = 0;           ///< processor time, packing and set-up left out [s]
    };

    std::size_t column_of(const Structure &structure, const std::string &name)
    {
      const auto columns = structure.columns();
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].name == name)
          return c;
      throw base::InputError("this bench needs a column " + name +
                             " of series.csv: a group \"load\" that is driven along z, and a probe "
                             "\"opening\".");
    }

    BeamRow bend(const SceneVariant &variant, const std::string &scene, const std::vector<std::string> &overrides)
    {
      const CheckedScene          checked = variant.of(scene, overrides);
      const StructureModel       &model   = model_of_kind<StructureModel>(checked, "structure");
      std::optional<dem::Packing> cell;
      const dem::Packing          packing = model.packing(&cell);
      const ParticleMedia         media   = model.media(cell);
      Promotion                   promotion(model, packing, media);
      const std::size_t           reaction = column_of(promotion.structure(), "reaction_load_z"),
                        opening            = column_of(promotion.structure(), "opening");
      const double start                   = base::processor_seconds();
      BeamRow      row{variant.study, variant.value};
      while (!promotion.structure().finished())
        {
          promotion.structure().advance();
          do
            {
              const std::vector<double> values = promotion.structure().row().values;
              if (std::fabs(values[reaction]) > row.peak)
                {
                  row.peak    = std::fabs(values[reaction]);
                  row.opening = values[opening];
                }
            }
          while (promotion.promote());
        }
      const Structure &structure = promotion.structure();
      row.cost                   = base::processor_seconds() - start;
      row.particles              = structure.network().network.particles();
      row.points                 = structure.way().points().size() - 1;
      row.balance                = structure.last().balance_error();
      for (const auto &[all, damaged] : structure.shared_bonds())
        row.damaged = static_cast<double>(damaged) / static_cast<double>(all);
      return row;
    }

    std::vector<SceneVariant> variants(const bool quick)
    {
      std::vector<SceneVariant> all = {{"method", "constrained", {}}};
      if (quick)
        return all;
      for (const char *ties : {"coarse", "strict"})
        all.push_back(
          {"method", ties, {"Handshakes/core/Method=multipliers", std::string("Handshakes/core/Ties=") + ties}});
      all.push_back({"method", "legacy", {"Handshakes/core/Method=legacy"}});
      all.push_back({"core", "30 mm", {"Handshakes/core/Low=0.045, -1, -1", "Handshakes/core/High=0.075, 1, 1"}});
      all.push_back({"core", "40 mm", {"Handshakes/core/Low=0.04, -1, -1", "Handshakes/core/High=0.08, 1, 1"}});
      for (const char *exertion : {"0.5", "0.9"})
        all.push_back(
          {"10 mm, promoted at",
           exertion,
           {"Handshakes/core/Low=0.055, -1, -1", "Handshakes/core/High=0.065, 1, 1",
            "Handshakes/core/Promotion reach=0.015", std::string("Handshakes/core/Promote at=") + exertion}});
      const std::string box = "Continuum/Mesh/Boxes/beam/Divisions ";
      all.push_back({"elements", "2.5 mm", {box + "x=48", box + "y=3", box + "z=8"}});
      return all;
    }

    void write(const BenchResults &results, const std::vector<BeamRow> &rows)
    {
      const BeamRow &whole = rows.front();
      std::string    csv   = "study,value,particles,points,peak [N],error [-],opening_at_peak [m],damaged_in_overlap "
                             "[-],balance_error [-],cost [s]\n";
      std::string md = "| Study | | Particles | Points | Peak [N] | Error | Opening at peak [um] | Damaged in overlap "
                       "| Energy balance | Cost [s] |\n"
                       "|---|---|---|---|---|---|---|---|---|---|\n";
      for (const BeamRow &r : rows)
        {
          const double error = r.peak / whole.peak - 1;
          csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", r.study, r.value, r.particles, r.points, r.peak, error,
                             r.opening, r.damaged, r.balance, r.cost);
          md += fmt::format("| {} | {} | {} | {} | {:.2f} | {:+.2f} % | {:.2f} | {:.1f} % | {:.1e} | {:.1f} |\n",
                            r.study, r.value, r.particles, r.points, r.peak, 100 * error, 1e6 * r.opening,
                            100 * r.damaged, r.balance, r.cost);
        }
      results.write(csv, md);
    }

    postprocess::PlotPanel panel_of(const std::vector<BeamRow> &rows)
    {
      std::vector<CostPoint> points;
      for (const BeamRow &row : rows)
        points.push_back({row.study, row.cost, std::fabs(row.peak / rows.front().peak - 1)});
      return error_over_cost("peak load against a beam all of particles", "Cost over that beam's", points);
    }
  } // namespace

  int run_structure_bench(const StructureBench &bench)
  {
    start_mpi();
    const BenchResults   results(bench.folder, "structure");
    std::vector<BeamRow> rows;
    const auto           note = [&](const BeamRow &row) {
      rows.push_back(row);
      write(results, rows);
      fmt::print(
                  "{:<10} {:<8} {:5} particles, peak {:.2f} N ({:+.2f} %), {:.1f} s ({:.1f} times cheaper), balance {:.1e}\n",
                  row.study, row.value, row.particles, row.peak, 100 * (row.peak / rows.front().peak - 1), row.cost,
                  rows.front().cost / row.cost, row.balance);
      std::fflush(stdout);
    };
    note(bend({"particles", "all", {}}, bench.whole, bench.overrides));
    for (const SceneVariant &variant : variants(bench.quick))
      note(bend(variant, bench.scene, bench.overrides));
    return results.finish({panel_of(rows)});
  }
} // namespace apps
