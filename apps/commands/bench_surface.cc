#include "apps/bench/surface.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_surface_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : SurfaceBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->scenes    = {"apps/scenes/hertz_impact.prm", "apps/scenes/colliding_balls.prm"};
    options->folder    = "output/bench_surface";
    CLI::App &command  = *bench.add_subcommand(
       "surface", "Impact on a solid, and of solids: force and time over mesh, step, sub-cycling and spreading");
    command
      .add_option("scene", options->scenes,
                  "Scenes of kind coupled, or of balls in contact, with known answers; default: " +
                    options->scenes.front() + " and " + options->scenes.back())
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scenes; repeatable");
    add_threads(command, options->threads);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Coarse meshes only");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_surface_bench(*options);
      };
    });
  }
} // namespace apps
