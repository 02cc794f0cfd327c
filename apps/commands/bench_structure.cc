#include "apps/bench/structure.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_structure_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : StructureBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_structure";
    CLI::App &command  = *bench.add_subcommand(
       "structure", "A notched beam with a core of particles against one all of particles: peak load and cost");
    command.add_option("whole", options->whole, "Scene of the beam all of particles; default: " + options->whole)
      ->type_name("SCENE");
    command.add_option("scene", options->scene, "Scene of the beam with a core; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of both scenes; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "One method only");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_structure_bench(*options);
      };
    });
  }
} // namespace apps
