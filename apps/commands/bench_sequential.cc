#include "apps/bench/sequential.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_sequential_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : SequentialBench
    {
      int threads = 0;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/transfer_compression.prm";
    options->folder    = "output/bench_sequential";
    CLI::App &command  = *bench.add_subcommand(
       "sequential", "Continuations against the all-particle run over instant of transfer, kernel and mesh");
    command.add_option("scene", options->scene, "Scene of kind sequential; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Fewer kernels and meshes");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_sequential_bench(*options);
      };
    });
  }
} // namespace apps
