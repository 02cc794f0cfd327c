#include "apps/bench/ranks_on_paper.h"

#include "apps/bench/cube_of_lattice.h"
#include "apps/bench/results.h"
#include "apps/forecasts/duration.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/specimens/rank_shares.h"
#include "dem/specimen/rank_shares.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace apps
{
  namespace
  {
    /** What a small cube says of large ones. */
    struct Costs
    {
      double update = 0; ///< of a link [s]
      double known = 0, of_link = 0, of_own = 0,
             of_ghost = 0; ///< of a particle that all ranks know, of a link, a particle and a ghost that a rank has [B]

      explicit Costs(const int cells)
      {
        dem::Specimen body      = cube_of_lattice(cells);
        const double  particles = static_cast<double>(body.counts().particles),
                     links      = static_cast<double>(body.counts().links);
        dem::RankShare share;
        const auto     bytes = [&] { return static_cast<double>(dem::least_bytes(body, share)); };
        known                = bytes() / particles;
        share.owned          = body.counts().links;
        of_link              = (bytes() - known * particles) / links;
        share.owned          = 0;
        share.end_particle   = body.counts().particles;
        of_own               = (bytes() - known * particles) / particles;
        share.end_particle   = 0;
        share.ghosts.resize(body.counts().particles);
        of_ghost = (bytes() - known * particles) / particles;
        update   = seconds_per_step(body, [&](const std::int64_t count) { body.advance(count); }) /
                 (static_cast<double>(dem::updates_per_particle) * particles + links);
      }

      double bytes(const dem::RankShare &share, const double particles) const
      {
        return known * particles + of_link * static_cast<double>(share.owned + share.copied.size()) +
               of_own * static_cast<double>(share.end_particle - share.first_particle) +
               of_ghost * static_cast<double>(share.ghosts.size());
      }
    };

    struct PaperRow
    {
      std::size_t ranks     = 0;
      double      particles = 0, efficiency = 0;
      double      rank_bytes = 0, whole_bytes = 0; ///< of the rank that needs most, and of one that has all
      RankTotals  all;
    };

    PaperRow row_of(const std::size_t ranks, const int cells, const Costs &costs)
    {
      const dem::LinkEnds links = links_of_cube(cells);
      PaperRow            row;
      row.ranks                                = ranks;
      row.particles                            = 4 * std::pow(cells, 3);
      const std::vector<dem::RankShare> shares = dem::share_out(static_cast<std::size_t>(row.particles), links, ranks);
      row.all                                  = totals_of(shares);
      row.efficiency                           = dem::parallel_efficiency(shares, costs.update, dem::Network());
      dem::RankShare whole;
      whole.owned        = links.size();
      whole.end_particle = static_cast<std::size_t>(row.particles);
      row.whole_bytes    = costs.bytes(whole, row.particles);
      for (const dem::RankShare &share : shares)
        row.rank_bytes = std::max(row.rank_bytes, costs.bytes(share, row.particles));
      return row;
    }

    void write(const BenchResults &results, const std::vector<PaperRow> &rows)
    {
      std::string csv =
        "ranks,particles,links,copies [-],updated twice [-],ghosts [-],most neighbours,most bytes sent [B],efficiency "
        "[-],memory of a rank [B],memory of all [B]\n";
      std::string md = "| Ranks | Particles | Links | Cut links [%] | Updated twice [%] | Ghosts [%] | Neighbours, at "
                       "most | Sent a step, at "
                       "most [kB] | Efficiency expected [%] | Memory of a rank [GB] | Memory of one with all [GB] "
                       "|\n|---|---|---|---|---|---|---|---|---|---|---|\n";
      for (const PaperRow &r : rows)
        {
          const double ghosts = static_cast<double>(r.all.ghosts) / r.particles;
          csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", r.ranks, r.particles, r.all.owned, r.all.copies(),
                             r.all.twice(), ghosts, r.all.most_neighbours, r.all.most_bytes, r.efficiency, r.rank_bytes,
                             r.whole_bytes);
          md +=
            fmt::format("| {} | {:.0f} | {} | {:.2f} | {:.2f} | {:.2f} | {} | {:.0f} | {:.1f} | {:.2f} | {:.2f} |\n",
                        r.ranks, r.particles, r.all.owned, 100 * r.all.copies(), 100 * r.all.twice(), 100 * ghosts,
                        r.all.most_neighbours, 1e-3 * static_cast<double>(r.all.most_bytes), 100 * r.efficiency,
                        1e-9 * r.rank_bytes, 1e-9 * r.whole_bytes);
        }
      results.write(csv, md);
    }

    std::vector<postprocess::PlotPanel> panels_of(const std::vector<PaperRow> &rows)
    {
      postprocess::PlotPanel gain, memory;
      gain.title     = "a million particles a rank, by the model";
      gain.x_label   = "Ranks";
      gain.y_label   = "Efficiency [%]";
      memory.title   = "memory of particles and links";
      memory.x_label = "Ranks";
      memory.y_label = "[GB]";
      gain.log_x = memory.log_x = memory.log_y = true;
      postprocess::PlotSeries efficiency, rank, whole;
      rank.name  = "of a rank, in steps";
      whole.name = "of the first, where it writes";
      for (const PaperRow &r : rows)
        {
          for (auto *series : {&efficiency, &rank, &whole})
            series->x.push_back(static_cast<double>(r.ranks));
          efficiency.y.push_back(100 * r.efficiency);
          rank.y.push_back(1e-9 * r.rank_bytes);
          whole.y.push_back(1e-9 * r.whole_bytes);
        }
      gain.series   = {efficiency};
      memory.series = {rank, whole};
      return {gain, memory};
    }
  } // namespace

  int run_ranks_on_paper(const RanksBench &bench)
  {
    const BenchResults results(bench.folder, "ranks_on_paper");
    catch_interrupts();
    const int   a_rank = bench.quick ? 16 : bench.cells;
    const Costs costs(std::min(a_rank, 40));
    fmt::print(
      "An update of a link takes {:.3g} ns here. A particle takes {:.0f} bytes in all ranks and {:.0f} in its own, "
      "a ghost {:.0f}, a link {:.0f}.\n",
      1e9 * costs.update, costs.known, costs.of_own, costs.of_ghost, costs.of_link);
    std::vector<PaperRow> rows;
    for (const std::size_t ranks : {1, 2, 4, 8, 17, 27})
      {
        const int cells = static_cast<int>(std::lround(a_rank * std::cbrt(static_cast<double>(ranks))));
        rows.push_back(row_of(ranks, cells, costs));
        write(results, rows);
        const PaperRow &row = rows.back();
        fmt::print("{:>3} ranks, {} links: {:.2f} % cut, {:.2f} % updated twice, {} neighbours at most, {:.1f} % "
                   "efficient, {:.2f} GB in a rank\n",
                   ranks, row.all.owned, 100 * row.all.copies(), 100 * row.all.twice(), row.all.most_neighbours,
                   100 * row.efficiency, 1e-9 * row.rank_bytes);
        std::fflush(stdout);
        if (interrupted())
          return exit_interrupted; // the table has every complete case
      }
    return results.finish(panels_of(rows));
  }
} // namespace apps
