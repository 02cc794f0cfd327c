#include "apps/bench/conservation.h"

#include "apps/bench/conservation_cases.h"
#include "apps/bench/results.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

namespace apps
{
  namespace
  {
    /** Up to which a momentum counts as kept, and below which an energy is rounding and has no order. */
    constexpr double kept = 1e-12, rounding = 1e-11;
    /** Of the longest stable window. */
    constexpr double coarse_step = 0.5, fine_step = 0.25;

    struct Row
    {
      CouplingCase       which;
      CouplingMotion     motion;
      ConservationAnswer coarse, fine;
      double             cost = 1; ///< of a window, over that of the first of the same kind and motion

      bool        keeps_momenta() const { return std::max(coarse.momentum, coarse.turning) <= kept; }
      std::string order() const
      {
        if (!(fine.energy > rounding))
          return "-";
        const double found = std::log2(coarse.energy / fine.energy) / std::log2(coarse_step / fine_step);
        return fmt::format("{:.1f}", std::fabs(found) < 0.05 ? 0.0 : found);
      }
    };

    void write(const BenchResults &results, const std::vector<Row> &rows)
    {
      std::string csv = "method,motion,momentum [-],angular_momentum [-],kept,energy [-],energy_at_half [-],order,lost "
                        "[-],lost_at_half [-],cost [-]\n";
      std::string md = "| Method | Motion | Momentum | Angular momentum | Both to 1e-12 | Energy unaccounted | at half "
                       "the step | Order | Lost by the coupling | at half | Cost of a window |\n"
                       "|---|---|---|---|---|---|---|---|---|---|---|\n";
      for (const Row &r : rows)
        {
          const char *both = r.keeps_momenta() ? "yes" : "no";
          csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", r.which.name, name_of(r.motion), r.coarse.momentum,
                             r.coarse.turning, both, r.coarse.energy, r.fine.energy, r.order(), r.coarse.lost,
                             r.fine.lost, r.cost);
          md += fmt::format("| {} | {} | {:.1e} | {:.1e} | {} | {:.1e} | {:.1e} | {} | {:.1e} | {:.1e} | {:.2f} |\n",
                            r.which.name, name_of(r.motion), r.coarse.momentum, r.coarse.turning, both, r.coarse.energy,
                            r.fine.energy, r.order(), r.coarse.lost, r.fine.lost, r.cost);
        }
      results.write(csv, md);
    }

    std::vector<CouplingMotion> motions_of(const bool quick)
    {
      if (quick)
        return {CouplingMotion::rotation, CouplingMotion::impact};
      return {CouplingMotion::translation, CouplingMotion::rotation, CouplingMotion::spin, CouplingMotion::pulse,
              CouplingMotion::impact};
    }

    /** Quick: the first of each kind. */
    std::vector<CouplingCase> cases_of(const bool quick)
    {
      std::vector<CouplingCase> chosen;
      for (const CouplingCase &one : coupling_cases())
        if (!quick || chosen.empty() || chosen.back().kind != one.kind)
          chosen.push_back(one);
      return chosen;
    }
  } // namespace

  int run_conservation_bench(const ConservationBench &bench)
  {
    start_mpi();
    const BenchResults results(bench.folder, "conservation");
    catch_interrupts();
    std::vector<Row>                                                rows;
    std::map<std::pair<CouplingCase::Kind, CouplingMotion>, double> first; ///< cost
    for (const CouplingCase &which : cases_of(bench.quick))
      for (const CouplingMotion motion : motions_of(bench.quick))
        {
          Row row{which, motion, measure_conservation(which, motion, coarse_step),
                  measure_conservation(which, motion, fine_step)};
          if (interrupted())
            return exit_interrupted; // the table has every complete case
          row.cost = row.fine.cost / first.emplace(std::pair(which.kind, motion), row.fine.cost).first->second;
          fmt::print("{:<54} {:<12} momentum {:.1e}, angular {:.1e}, energy {:.1e} of order {}, lost {:.1e}\n",
                     which.name, name_of(motion), row.coarse.momentum, row.coarse.turning, row.coarse.energy,
                     row.order(), row.coarse.lost);
          std::fflush(stdout);
          rows.push_back(row);
          write(results, rows);
        }
    fmt::print("table in {}\n", (bench.folder / "conservation.md").string());
    return exit_success;
  }
} // namespace apps
