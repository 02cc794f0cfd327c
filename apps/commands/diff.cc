#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/results/folder_reading.h"
#include "apps/results/result_difference.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <memory>

namespace apps
{
  namespace
  {
    struct DiffOptions
    {
      std::string first, second;
      double      tolerance = 0;
    };

    std::string line_of(const ResultDifference &difference)
    {
      if (!difference.only.empty())
        return fmt::format("  {:<32} only in the {}\n", difference.name, difference.only);
      const std::string where = difference.row < 0 ? "" : fmt::format(", most in row {}", difference.row);
      return fmt::format("  {:<32} {:.10g} and {:.10g} {}: {:.2g}{}\n", difference.name, difference.first,
                         difference.second, difference.unit, difference.part, where);
    }

    /** @return how many differ by more than the tolerance */
    std::size_t
    print_differences(const char *what, const std::vector<ResultDifference> &differences, const double tolerance)
    {
      fmt::print("{}: {}\n", what,
                 differences.empty() ? "the same bits" : fmt::format("{} differ", differences.size()));
      std::size_t beyond = 0;
      for (const ResultDifference &difference : differences)
        {
          fmt::print("{}", line_of(difference));
          beyond += difference.part > tolerance;
        }
      return beyond;
    }

    void print_files(const ComparedFiles &files)
    {
      const auto list = [](const char *what, const std::vector<std::string> &names) {
        if (!names.empty())
          fmt::print("files {}: {}\n", what, fmt::join(names, ", "));
      };
      list("of the same bytes", files.same);
      list("of other bytes", files.other);
      list("only in the first", files.only_first);
      list("only in the second", files.only_second);
    }

    int compare_results(const DiffOptions &options)
    {
      const RunResult first = read_result(options.first), second = read_result(options.second);
      std::size_t     beyond =
        print_differences("figures", differing_figures(first, second), options.tolerance) +
        print_differences("series", differing_columns(first.series, second.series), options.tolerance);
      if (first.series.rows() != second.series.rows())
        {
          fmt::print("series: {} rows and {}\n", first.series.rows(), second.series.rows());
          ++beyond;
        }
      print_files(compared_files(options.first, options.second));
      return beyond > 0 ? exit_failure : exit_success;
    }
  } // namespace

  void add_diff(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<DiffOptions>();
    CLI::App  &command = *program.add_subcommand("diff", "Two folders of results: figures, series and bits");
    command.footer("A difference is over the larger of both values, in a series over the largest of its column.\n"
                   "Exit status: 0 where figures and series are the same to the tolerance, 1 where they are not.");
    command.add_option("first", options->first, "Results of a run")->required()->type_name("DIR");
    command.add_option("second", options->second, "Results of another one")->required()->type_name("DIR");
    command.add_option("--tolerance", options->tolerance, "Difference that counts as none; default: 0, the same bits")
      ->type_name("PART")
      ->check(CLI::Range(0.0, 1.0).description(""));
    command.callback([options, &chosen] { chosen = [options] { return compare_results(*options); }; });
  }
} // namespace apps
