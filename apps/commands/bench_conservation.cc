#include "apps/bench/conservation.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_conservation_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : ConservationBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_conservation";
    CLI::App &command  = *bench.add_subcommand(
       "conservation", "Every way of coupling in every motion: momenta, energy with its order in the step, cost");
    add_threads(command, options->threads);
    add_bench_folder(command, options->folder, "the table");
    command.add_flag("--quick", options->quick, "One method of each kind, rotation and impact only");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_conservation_bench(*options);
      };
    });
  }
} // namespace apps
