#include "apps/bench/homogenise.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_homogenise_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : HomogeniseBench
    {
      int threads = 1;
    };
    const auto options = std::make_shared<Options>();
    options->folder    = "output/bench_homogenise";
    CLI::App &command =
      *bench.add_subcommand("homogenise", "Macroscopic stiffness over cell size, solver, tolerance and seed");
    add_bench_folder(command, options->folder);
    command.add_option("--particles", options->particles, "Cells of the study of solvers; default: 500,1000,4000")
      ->delimiter(',')
      ->type_name("N,N,...")
      ->check(CLI::Range(8, 1000000));
    command
      .add_option("--seed-particles", options->seed_particles, "Cells of the study of seeds; default: 64,...,2000")
      ->delimiter(',')
      ->type_name("N,N,...")
      ->check(CLI::Range(8, 1000000));
    command.add_option("--seeds", options->seeds, "Packings per cell size; default: 8")
      ->check(CLI::Range(2, 1000))
      ->type_name("N");
    command.add_option("--interaction-ratio", options->interaction_ratio, "default: 1.5")
      ->type_name("IOTA")
      ->check(CLI::Range(1.0, 10.0));
    command.add_option("--shear-ratio", options->shear_ratio, "default: 0.2")
      ->type_name("G/E")
      ->check(CLI::PositiveNumber);
    command.add_flag("--quick", options->quick, "Cells of 64 and 125 spheres, three seeds");
    add_threads(command, options->threads);
    add_no_cache(command);
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_homogenise_bench(*options);
      };
    });
  }
} // namespace apps
