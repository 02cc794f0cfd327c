#include "apps/bench/size_effect.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_size_effect_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : SizeEffectBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_size_effect";
    CLI::App &command  = *bench.add_subcommand(
       "size-effect", "Beams of one shape and several sizes, notched and smooth: strengths beside laws of size effect");
    command.add_option("scene", options->scene, "Scene of the smallest beam; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_option("--sizes", options->sizes, "Over that of the scene; default: 1,2,4,8")
      ->delimiter(',')
      ->check(CLI::Range(1, 64))
      ->type_name("N,...");
    command.add_option("--geometries", options->geometries, "Of particles and aggregates, per size; default: 3")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
    command
      .add_option("--calibrated", options->calibrated, "Size from which alone the others are predicted; default: 2")
      ->type_name("N");
    command
      .add_option("--particles", options->particles,
                  "Of the sizes, beams all of particles beside; 0: none; default: 1,2")
      ->delimiter(',')
      ->check(CLI::Range(0, 64))
      ->type_name("N,...");
    command.add_flag_callback(
      "--notched-only", [options] { options->smooth = false; }, "No beams without a notch");
    command.add_flag("--restart", options->restart, "Throw away what an interrupted bench has left in the folder");
    command.add_flag("--quick", options->quick, "One geometry of sizes 1 and 2, with a notch");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_size_effect_bench(*options);
      };
    });
  }
} // namespace apps
