#include "apps/bench/mortar.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <memory>

namespace apps
{
  void add_mortar_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : MortarBench
    {
      int threads = 0;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/mortar_window.prm";
    options->folder    = "output/bench_mortar";
    CLI::App &command  = *bench.add_subcommand("mortar", "Strength and modulus of a grown, jointed specimen over size "
                                                          "of particles, speed, damping and elements per joint");
    command
      .add_option("scene", options->scene,
                  "Scene of kind particles with Genesis and Laboratory; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_bench_folder(command, options->folder);
    command.add_flag("--quick", options->quick, "Fewer cases");
    command.add_flag("--static-strength", options->static_strength,
                     "Follow equilibria without inertia to failure, too: for small windows");
    command.add_flag(
      "--constants", options->constants,
      "Instead: what each constant of the joints does to strength and modulus, beside what is published");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_mortar_bench(*options);
      };
    });
  }
} // namespace apps
