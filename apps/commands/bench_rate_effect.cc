#include "apps/bench/rate_effect.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_rate_effect_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : RateEffectBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/rate_effect.prm";
    options->folder    = "output/bench_rate_effect";
    CLI::App &command =
      *bench.add_subcommand("rate-effect", "Strength over the rate of strain, beside the fib Model Code");
    command.add_option("scene", options->scene, "Scene of kind uniaxial; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_bench_folder(command, options->folder);
    command.add_option("--rates", options->rates, "Rates of strain [1/s]; default: 1e-6 to 100")
      ->delimiter(',')
      ->type_name("R,R,...")
      ->check(CLI::PositiveNumber);
    command.add_flag("--quick", options->quick, "Four rates");
    add_threads(command, options->threads);
    add_no_cache(command);
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_rate_effect_bench(*options);
      };
    });
  }
} // namespace apps
