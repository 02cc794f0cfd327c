#include "apps/bench/volume.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_volume_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : VolumeBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/wave_transmission.prm";
    options->folder    = "output/bench_volume";
    CLI::App &command  = *bench.add_subcommand(
       "volume", "Waves from particles into a continuum: reflected energy and cost, by every method");
    command.add_option("scene", options->scene, "Scene of kind transmission; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Two wavelengths only");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_volume_bench(*options);
      };
    });
  }
} // namespace apps
