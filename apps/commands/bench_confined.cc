#include "apps/bench/confined.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_confined_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : ConfinedBench
    {
      int threads = 0;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/rock_triaxial.prm";
    options->folder    = "output/bench_confined";
    CLI::App &command  = *bench.add_subcommand(
       "confined", "Strength of a specimen over the pressure around it: a biaxial or triaxial family");
    command
      .add_option("scene", options->scene,
                  "Scene of kind particles with a biaxial or triaxial test; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_option("--pressures", options->pressures, "Confining pressures [Pa]; default: 0.5e6 2e6 5e6 10e6")
      ->check(CLI::PositiveNumber)
      ->delimiter(',')
      ->type_name("P,...");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_confined_bench(*options);
      };
    });
  }
} // namespace apps
