#include "apps/bench/quasi_static.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_quasi_static_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : QuasiStaticBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/concrete_uniaxial.prm";
    options->folder    = "output/bench_quasi_static";
    CLI::App &command =
      *bench.add_subcommand("quasi-static", "Tensile strength without inertia and at falling loading rates");
    command.add_option("scene", options->scene, "Scene of kind uniaxial; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_bench_folder(command, options->folder);
    command
      .add_option("--rates", options->rates, "Strain rates of the dynamic runs [1/s]; default: 10,3,1,0.3,0.1,0.03")
      ->delimiter(',')
      ->type_name("R,R,...")
      ->check(CLI::PositiveNumber);
    command.add_flag("--quick", options->quick, "A smaller specimen, three rates");
    add_threads(command, options->threads);
    add_no_cache(command);
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_quasi_static_bench(*options);
      };
    });
  }
} // namespace apps
