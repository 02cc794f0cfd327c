#include "apps/bench/continuum.h"

#include "apps/bench/continuum_cases.h"
#include "apps/bench/continuum_rates.h"
#include "apps/bench/results.h"
#include "apps/process/exit_status.h"
#include "apps/process/mpi_session.h"
#include "postprocess/files/atomic_file.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>

namespace apps
{
  namespace
  {
    struct Table
    {
      std::vector<ContinuumError> errors;
      std::vector<ContinuumRate>  rates;
      std::vector<std::string>    ranks; ///< rows of continuum_ranks.csv
    };

    const char *rank_header = "ranks,elements,unknowns,mesh [s],set-up [s],solution [s],updates [1/s/core],"
                              "kernel updates [1/s/core],solver\n";

    std::string rank_row(const RankFigures &f)
    {
      std::string solver = f.solver;
      for (char &c : solver)
        if (c == ',')
          c = ';';
      return fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{:.4g},{:.4g},{}", f.ranks, f.elements, f.unknowns, f.mesh,
                         f.set_up, f.solution, f.updates, f.kernel, solver);
    }

    /** Rows of earlier runs, but those of this problem and number of ranks: they are measured now. */
    std::vector<std::string> other_rank_rows(const std::filesystem::path &file, const std::vector<std::string> &now)
    {
      const auto key = [](const std::string &row) { // ranks,elements
        return row.substr(0, row.find(',', row.find(',') + 1));
      };
      std::vector<std::string> rows;
      std::ifstream            in(file);
      std::string              line;
      std::getline(in, line); // header
      while (std::getline(in, line))
        {
          bool replaced = false;
          for (const std::string &row : now)
            replaced = replaced || key(row) == key(line);
          if (!replaced)
            rows.push_back(line);
        }
      return rows;
    }

    std::string markdown(const Table &table)
    {
      std::string md = "# Error over cost\n\n| Element | Solver | Divisions | Unknowns | Iterations | Cost [s] | Error "
                       "|\n|---|---|---|---|---|---|---|\n";
      for (const auto &r : table.errors)
        md += fmt::format("| {} | {} | {} | {} | {} | {:.3f} | {:.2e} |\n", r.which.element_name(),
                          r.which.solver_name(), r.which.divisions, r.unknowns, r.iterations, r.cost, r.error);
      md +=
        "\n# Unknowns per second of one core, beside a plain deal.II program\n\n| Operation | Unknowns | Breccia [1/s] "
        "| plain [1/s] | ratio |\n|---|---|---|---|---|\n";
      for (const auto &r : table.rates)
        md += fmt::format("| {} | {} | {:.3g} | {:.3g} | {:.1f} |\n", r.operation, r.unknowns, r.per_second(r.ours),
                          r.per_second(r.plain), r.plain / r.ours);
      md += "\n# Ranks\n\n" + std::string(rank_header);
      for (const std::string &row : table.ranks)
        md += "\n" + row + "\n";
      return md;
    }

    void write(const std::filesystem::path &folder, const BenchResults &results, const Table &table)
    {
      std::string csv = "operation,unknowns,breccia [s],plain [s]\n";
      for (const auto &r : table.rates)
        csv += fmt::format("{},{},{},{}\n", r.operation, r.unknowns, r.ours, r.plain);
      postprocess::write_text(folder / "continuum_rates.csv", csv);
      csv = "element,solver,divisions,unknowns,iterations,cost [s],error [-]\n";
      for (const auto &r : table.errors)
        csv += fmt::format("{},{},{},{},{},{},{}\n", r.which.element_name(), r.which.solver_name(), r.which.divisions,
                           r.unknowns, r.iterations, r.cost, r.error);
      results.write(csv, markdown(table));
    }

    postprocess::PlotPanel panel(const std::string &title, const std::string &x, const std::string &y)
    {
      postprocess::PlotPanel p;
      p.title   = title;
      p.x_label = x;
      p.y_label = y;
      p.log_x = p.log_y = true;
      return p;
    }

    postprocess::PlotSeries &series_of(postprocess::PlotPanel &p, const std::string &name)
    {
      for (auto &s : p.series)
        if (s.name == name)
          return s;
      p.series.emplace_back();
      p.series.back().name = name;
      return p.series.back();
    }

    std::vector<postprocess::PlotPanel> panels_of(const Table &table)
    {
      auto hexahedra  = panel("hexahedra", "Processor time [s]", "Relative error of the displacement");
      auto tetrahedra = panel("tetrahedra", "Processor time [s]", "Relative error of the displacement");
      auto rates      = panel("one core, beside a plain deal.II program", "Unknowns", "Unknowns per second");
      for (const auto &r : table.errors)
        {
          auto &s = series_of(r.which.family == fem::ElementFamily::hypercube ? hexahedra : tetrahedra,
                              r.which.element_name() + " " + r.which.solver_name());
          s.x.push_back(r.cost);
          s.y.push_back(r.error);
        }
      for (const auto &r : table.rates)
        for (const bool ours : {true, false})
          {
            if (r.operation == "product" || r.operation == "solver iteration")
              continue; // in the table; the figure stays readable
            auto &s = series_of(rates, r.operation + (ours ? "" : ", plain"));
            s.x.push_back(static_cast<double>(r.unknowns));
            s.y.push_back(r.per_second(ours ? r.ours : r.plain));
          }
      return {hexahedra, tetrahedra, rates};
    }

    void measure_on_one_rank(const ContinuumBench &bench, Table &table)
    {
      for (const ContinuumCase &which : continuum_cases(bench.quick))
        {
          table.errors.push_back(solve_case(which));
          const auto &r = table.errors.back();
          fmt::print("{} {:<19} {:>8} unknowns {:>4} iterations {:>8.3f} s  error {:.2e}\n", which.element_name(),
                     which.solver_name(), r.unknowns, r.iterations, r.cost, r.error);
          std::fflush(stdout);
        }
      for (const unsigned int divisions :
           bench.quick ? std::vector<unsigned int>{6, 12} : std::vector<unsigned int>{8, 16, 32})
        for (const auto &r : measure_rates(divisions))
          {
            table.rates.push_back(r);
            fmt::print("{:<17} {:>8} unknowns: {:>9.3g} unknowns/s, plain deal.II {:>9.3g}\n", r.operation, r.unknowns,
                       r.per_second(r.ours), r.per_second(r.plain));
            std::fflush(stdout);
          }
    }
  } // namespace

  int run_continuum_bench(const ContinuumBench &bench)
  {
    start_mpi();
    std::optional<BenchResults> results; // on the first rank
    on_first_rank([&] { results.emplace(bench.folder, "continuum"); });
    Table table;
    for (const unsigned int divisions : bench.quick ? std::vector<unsigned int>{16} : std::vector<unsigned int>{32, 72})
      {
        const RankFigures f = measure_on_ranks(divisions, MPI_COMM_WORLD);
        table.ranks.push_back(rank_row(f));
        if (is_first_rank())
          fmt::print("{} rank(s), {} unknowns: mesh {:.2f} s, set-up {:.2f} s, solution {:.2f} s; explicit {:.3g} "
                     "updates/s/core\n",
                     f.ranks, f.unknowns, f.mesh, f.set_up, f.solution, f.updates);
      }
    on_first_rank([&] {
      const auto file = bench.folder / "continuum_ranks.csv";
      auto       rows = other_rank_rows(file, table.ranks);
      rows.insert(rows.end(), table.ranks.begin(), table.ranks.end());
      table.ranks     = rows;
      std::string csv = rank_header;
      for (const std::string &row : rows)
        csv += row + "\n";
      postprocess::write_text(file, csv);
      if (rank_count() > 1)
        {
          fmt::print("written to {}\n", file.string());
          return;
        }
      measure_on_one_rank(bench, table);
      write(bench.folder, *results, table);
      results->finish(panels_of(table));
    });
    return exit_success;
  }
} // namespace apps
