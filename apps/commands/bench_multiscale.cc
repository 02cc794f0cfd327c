#include "apps/bench/multiscale.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_multiscale_bench(CLI::App &bench, Action &chosen)
  {
    const auto options = std::make_shared<MultiscaleBench>();
    options->scene     = "apps/scenes/cells_in_beam.prm";
    options->plate     = "apps/scenes/cells_at_hole.prm";
    options->folder    = "output/bench_multiscale";
    CLI::App &command  = *bench.add_subcommand(
       "multiscale", "Cells behind integration points: what one costs, and where needed against everywhere");
    command.add_option("scene", options->scene, "Plane scene of kind continuum with cells; default: " + options->scene)
      ->type_name("SCENE");
    command
      .add_option("--plate", options->plate,
                  "Scene that is driven in equilibrium and in motion; default: " + options->plate)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Small cells, and a short part of the curve only");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_multiscale_bench(*options);
      };
    });
  }
} // namespace apps
