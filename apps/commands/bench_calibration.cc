#include "apps/bench/calibration.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_calibration_bench(CLI::App &bench, Action &chosen)
  {
    const auto folder  = std::make_shared<std::filesystem::path>("output/bench_calibration");
    CLI::App  &command = *bench.add_subcommand(
       "calibration", "Runs that constants take, by ways to search, beside plain finite differences");
    add_bench_folder(command, *folder);
    command.callback([folder, &chosen] { chosen = [folder] { return run_calibration_bench(*folder); }; });
  }
} // namespace apps
