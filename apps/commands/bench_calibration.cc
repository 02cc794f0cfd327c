#include "apps/bench/calibration.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_calibration_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<CalibrationBench> command(
      bench, "calibration", "Runs that constants take, by ways to search, beside plain finite differences");
    command.folder();
    command.runs(chosen, run_calibration_bench);
  }
} // namespace apps
