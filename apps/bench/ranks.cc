#include "apps/bench/ranks.h"

#include "apps/bench/cube_of_lattice.h"
#include "apps/bench/ranks_on_paper.h"
#include "apps/bench/results.h"
#include "apps/forecasts/duration.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_ranks.h"
#include "apps/process/mpi_session.h"
#include "apps/specimens/rank_shares.h"
#include "base/stopwatch.h"
#include "dem/ranks/exact_sum.h"
#include "dem/specimen/rank_shares.h"
#include "dem/specimen/specimen.h"

#include <fmt/format.h>

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace apps
{
  namespace
  {
    struct SumRow
    {
      std::string values;
      double      plain = 0, exact = 0, merged = 0; ///< an addition of a double, the same without loss, of two sums [s]
      double      off = 0; ///< of the plain sum from the exact one, over the sum of magnitudes [-]
    };

    struct ShareRow
    {
      std::size_t ranks = 0;
      RankTotals  all;
      double      efficiency = 0;
    };

    /** Random values of both signs. @param places exponents of two that they spread over, evenly */
    std::vector<double> random_values(const int places)
    {
      std::mt19937_64     bits(1);
      std::vector<double> values(std::size_t{1} << 20);
      for (double &value : values)
        {
          value = std::ldexp(1 + std::ldexp(static_cast<double>(bits() >> 12), -52),
                             -static_cast<int>(bits() % static_cast<std::uint64_t>(places)));
          value = bits() % 2 == 0 ? value : -value;
        }
      return values;
    }

    SumRow time_sums(const std::string &name, const int places)
    {
      const std::vector<double> values = random_values(places);
      const auto                passes = [](const auto &pass) {
        return [&pass](const std::int64_t count) {
          for (std::int64_t k = 0; k < count; ++k)
            pass();
          return count;
        };
      };
      double size = 0;
      for (const double value : values)
        size += std::abs(value);
      double        plain = 0;
      dem::ExactSum exact, parts;
      const auto    add_plain = [&] {
        plain = 0;
        for (const double value : values)
          plain += value;
      };
      const auto add_exact = [&] {
        exact = {};
        for (const double value : values)
          exact.add(value);
      };
      const auto   merge = [&] { parts.add(exact); };
      const double n     = static_cast<double>(values.size());
      SumRow       row{name, seconds_per_unit(passes(add_plain)) / n, seconds_per_unit(passes(add_exact)) / n,
                 seconds_per_unit(passes(merge)), 0};
      row.off = std::abs(plain - exact.value()) / size;
      return row;
    }

    std::string sums_in_words(const std::vector<SumRow> &rows)
    {
      std::string md =
        "| Sums of 2^20 doubles | Plain [ns each] | Without loss [ns each] | Two sums added [ns] | Plain "
        "sum off, over magnitudes |\n|---|---|---|---|---|\n";
      for (const SumRow &r : rows)
        md += fmt::format("| {} | {:.2f} | {:.2f} | {:.0f} | {:.1e} |\n", r.values, 1e9 * r.plain, 1e9 * r.exact,
                          1e9 * r.merged, r.off);
      return md;
    }

    void write_shares(const BenchResults          &results,
                      const std::vector<SumRow>   &sums,
                      const std::vector<ShareRow> &rows,
                      const double                 particles)
    {
      std::string csv = "ranks,copies [-],ghosts [-],largest work over mean [-],most neighbours,most bytes [B],"
                        "efficiency [-]\n";
      std::string md  = "\n| Ranks | Cut links [%] | Ghosts [%] | Largest share over the mean | Neighbours, at most | "
                        "Sent a step, at most [kB] | Efficiency expected [%] |\n|---|---|---|---|---|---|---|\n";
      for (const ShareRow &r : rows)
        {
          const double ghosts  = static_cast<double>(r.all.ghosts) / particles;
          const double largest = r.all.largest_work * static_cast<double>(r.ranks) / r.all.work;
          csv += fmt::format("{},{},{},{},{},{},{}\n", r.ranks, r.all.copies(), ghosts, largest, r.all.most_neighbours,
                             r.all.most_bytes, r.efficiency);
          md += fmt::format("| {} | {:.2f} | {:.2f} | {:.3f} | {} | {:.0f} | {:.1f} |\n", r.ranks, 100 * r.all.copies(),
                            100 * ghosts, largest, r.all.most_neighbours, 1e-3 * static_cast<double>(r.all.most_bytes),
                            100 * r.efficiency);
        }
      results.write(csv, sums_in_words(sums) + md);
    }

    std::vector<postprocess::PlotPanel> rank_panels(const std::vector<ShareRow> &rows, const double particles)
    {
      postprocess::PlotPanel cut, gain;
      cut.title    = "what is computed or held twice";
      cut.x_label  = "Ranks";
      cut.y_label  = "Part of all [%]";
      gain.title   = "efficiency expected by the model";
      gain.x_label = "Ranks";
      gain.y_label = "Efficiency [%]";
      cut.log_x = gain.log_x = true;
      postprocess::PlotSeries copies, ghosts, efficiency;
      copies.name = "cut links";
      ghosts.name = "ghosts";
      for (const ShareRow &r : rows)
        {
          const auto ranks = static_cast<double>(r.ranks);
          copies.x.push_back(ranks);
          copies.y.push_back(100 * r.all.copies());
          ghosts.x.push_back(ranks);
          ghosts.y.push_back(100 * static_cast<double>(r.all.ghosts) / particles);
          efficiency.x.push_back(ranks);
          efficiency.y.push_back(100 * r.efficiency);
        }
      cut.series  = {copies, ghosts};
      gain.series = {efficiency};
      return {cut, gain};
    }
  } // namespace

  namespace
  {
    /** The ranks that have nothing to do sleep until the first is ready: those that wait for a message keep a processor busy. */
    void wait_for_first_rank(const std::function<void()> &work)
    {
      MPI_Request ready;
      if (is_first_rank())
        work();
      MPI_Ibarrier(MPI_COMM_WORLD, &ready);
      for (int done = 0; done == 0;)
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          MPI_Test(&ready, &done, MPI_STATUS_IGNORE);
        }
    }

    /** The same number of steps on each rank, which must all take part. @return seconds of a step */
    double seconds_of_steps(dem::Specimen &body, const std::int64_t steps)
    {
      body.advance(2); // shares are found, and pages touched
      const base::Stopwatch watch;
      body.advance(steps);
      return watch.seconds() / static_cast<double>(steps);
    }

    int run_shared_steps(const RanksBench &bench)
    {
      const int              cells  = bench.quick ? 16 : bench.cells;
      constexpr std::int64_t rounds = 3;
      std::vector<double>    alone, shared;
      dem::Specimen          body  = cube_of_lattice(cells, launched_team().get());
      const double           count = static_cast<double>(body.counts().particles);
      const std::int64_t     steps = std::max<std::int64_t>(5, static_cast<std::int64_t>(2e7 / count));
      dem::Specimen          other = body;
      share_among_ranks(other);
      for (std::int64_t k = 0; k < rounds; ++k)
        {
          wait_for_first_rank([&] { alone.push_back(seconds_of_steps(body, steps)); });
          shared.push_back(seconds_of_steps(other, steps));
        }
      const std::vector<dem::RankWork> work = other.shares();
      if (!is_first_rank())
        return exit_success;
      const auto   ranks  = static_cast<std::size_t>(rank_count());
      const double one    = *std::min_element(alone.begin(), alone.end()),
                   all    = *std::min_element(shared.begin(), shared.end());
      const auto   shares = dem::share_out(body, ranks);
      const double update = one / dem::seconds_of_step(dem::share_out(body, 1), 1.0, dem::Network());
      const double model  = dem::seconds_of_step(shares, update, dem::Network());
      std::int64_t sent = 0, copies = 0, links = 0;
      for (const dem::RankWork &rank : work)
        {
          sent = std::max(sent, rank.bytes);
          copies += rank.copies;
          links += rank.links;
        }
      const double steps_taken = static_cast<double>(rounds * (steps + 2));
      fmt::print(
        "{:.0f} particles on {} ranks: a step takes {:.4g} s alone and {:.4g} s shared, {:.2f} times as fast; {:.4g} s "
        "({:.2f} times) expected. {:.2f} % of links copied, {:.0f} kB sent a step by a rank at most.\n",
        count, ranks, one, all, one / all, model, one / model,
        100 * static_cast<double>(copies) / static_cast<double>(links), 1e-3 * static_cast<double>(sent) / steps_taken);
      return exit_success;
    }
  } // namespace

  namespace
  {
    /** What the system says of this process [B]; 0 where it says nothing. @param line of /proc/self/status */
    double process_memory(const std::string &line)
    {
      std::ifstream status("/proc/self/status");
      for (std::string name; status >> name; std::getline(status, name))
        if (name == line + ":")
          {
            double kilobytes = 0;
            status >> kilobytes;
            return 1024 * kilobytes;
          }
      return 0;
    }

    struct RankMemory
    {
      double specimen = 0;             ///< of particles and links while steps are taken [B]
      double process = 0, at_most = 0; ///< of the process then, and at most since it began [B]
    };

    int run_memory(const RanksBench &bench)
    {
      dem::Specimen body = cube_of_lattice(bench.quick ? 16 : bench.cells, launched_team().get());
      share_among_ranks(body);
      const double                       seconds = seconds_of_steps(body, bench.memory_steps);
      const double                       mine[]  = {process_memory("VmRSS"), process_memory("VmHWM")};
      std::vector<RankMemory>            of(static_cast<std::size_t>(rank_count()));
      const std::vector<dem::RankMemory> held = dem::memory_of_ranks(body);
      std::vector<double>                all(2 * of.size(), 0.0);
      std::copy_n(mine, 2, all.data());
      if (rank_count() > 1)
        MPI_Allgather(mine, 2, MPI_DOUBLE, all.data(), 2, MPI_DOUBLE, MPI_COMM_WORLD);
      RankMemory sum;
      for (std::size_t r = 0; r < of.size(); ++r)
        {
          of[r] = {static_cast<double>(held.empty() ? static_cast<std::int64_t>(body.bytes()) : held[r].in_steps),
                   all[2 * r], all[2 * r + 1]};
          sum   = {sum.specimen + of[r].specimen, sum.process + of[r].process, sum.at_most + of[r].at_most};
        }
      const dem::Counts counts = body.counts();
      if (!is_first_rank())
        return exit_success;
      fmt::print("{} particles, {} links, {} steps of {:.4g} s\n\n| Rank | Particles and links [MB] | Process while "
                 "steps are taken [MB] | At most since it began [MB] |\n|---|---|---|---|\n",
                 counts.particles, counts.links, bench.memory_steps, seconds);
      const auto row = [](const std::string &name, const RankMemory &m) {
        fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} |\n", name, 1e-6 * m.specimen, 1e-6 * m.process, 1e-6 * m.at_most);
      };
      for (std::size_t r = 0; r < of.size(); ++r)
        row(fmt::format("{}", r), of[r]);
      row("all", sum);
      return exit_success;
    }
  } // namespace

  int run_ranks_bench(const RanksBench &bench)
  {
    start_mpi_for_ranks();
    if (bench.memory_steps > 0)
      return run_memory(bench);
    if (rank_count() > 1)
      return run_shared_steps(bench);
    if (bench.on_paper)
      return run_ranks_on_paper(bench);
    const BenchResults results(bench.folder, "ranks");
    catch_interrupts();
    const std::vector<SumRow> sums = {time_sums("of 20 exponents", 20), time_sums("of 1000 exponents", 1000)};
    fmt::print("{}", sums_in_words(sums));
    std::fflush(stdout);
    dem::Specimen body      = cube_of_lattice(bench.quick ? 16 : bench.cells);
    const double  particles = static_cast<double>(body.counts().particles);
    const double  step      = seconds_per_step(body, [&](const std::int64_t count) { body.advance(count); });
    fmt::print("{:.0f} particles, {} links, {:.3g} s a step\n", particles, body.counts().links, step);
    std::vector<ShareRow> rows;
    for (const std::size_t ranks : {1, 2, 3, 8, 27, 64})
      {
        const std::vector<dem::RankShare> shares = dem::share_out(body, ranks);
        const RankTotals                  all    = totals_of(shares);
        const double alone = step / (all.work - static_cast<double>(all.copied)); // of an update of a link
        rows.push_back({ranks, all, dem::parallel_efficiency(shares, alone, dem::Network())});
        write_shares(results, sums, rows, particles);
        fmt::print("{:>3} ranks: {:.2f} % of links cut, {:.2f} % ghosts, {} neighbours at most, {:.1f} % efficient\n",
                   ranks, 100 * all.copies(), 100 * static_cast<double>(all.ghosts) / particles, all.most_neighbours,
                   100 * rows.back().efficiency);
        std::fflush(stdout);
        if (interrupted())
          return exit_interrupted; // the table has every complete case
      }
    return results.finish(rank_panels(rows, particles));
  }
} // namespace apps
