#include "apps/bench/peridynamics.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_peridynamics_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : PeridynamicsBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_peridynamics";
    CLI::App &command  = *bench.add_subcommand(
       "peridynamics",
       "Errors of a plate in tension and shear over its grid, steps of relaxations, bond updates a second");
    add_threads(command, options->threads);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Coarse grids only, and no relaxations");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_peridynamics_bench(*options);
      };
    });
  }
} // namespace apps
