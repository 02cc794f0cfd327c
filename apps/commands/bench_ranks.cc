#include "apps/bench/ranks.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_ranks_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : RanksBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_ranks";
    CLI::App &command  = *bench.add_subcommand(
       "ranks", "Sums without loss, and a million particles shared out among ranks: cut links, ghosts, efficiency");
    add_threads(command, options->threads);
    add_bench_folder(command, options->folder);
    command.add_option("--cells", options->cells, "Lattice cells along each edge, of four particles; default: 63")
      ->check(CLI::Range(4, 400))
      ->type_name("N");
    command.add_flag("--quick", options->quick, "16 lattice cells along each edge");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_ranks_bench(*options);
      };
    });
  }
} // namespace apps
