#include "apps/bench/uniaxial.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_calibration_bench(CLI::App &bench, Action &chosen);
  void add_confined_bench(CLI::App &bench, Action &chosen);
  void add_conservation_bench(CLI::App &bench, Action &chosen);
  void add_continuum_bench(CLI::App &bench, Action &chosen);
  void add_homogenise_bench(CLI::App &bench, Action &chosen);
  void add_mesoscale_bench(CLI::App &bench, Action &chosen);
  void add_mortar_bench(CLI::App &bench, Action &chosen);
  void add_multiscale_bench(CLI::App &bench, Action &chosen);
  void add_peridynamics_bench(CLI::App &bench, Action &chosen);
  void add_sequential_bench(CLI::App &bench, Action &chosen);
  void add_quasi_static_bench(CLI::App &bench, Action &chosen);
  void add_ranks_bench(CLI::App &bench, Action &chosen);
  void add_rate_effect_bench(CLI::App &bench, Action &chosen);
  void add_size_effect_bench(CLI::App &bench, Action &chosen);
  void add_structure_bench(CLI::App &bench, Action &chosen);
  void add_surface_bench(CLI::App &bench, Action &chosen);
  void add_volume_bench(CLI::App &bench, Action &chosen);

  void add_bench(CLI::App &program, Action &chosen)
  {
    struct Options : UniaxialBench
    {
      int threads = 0;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/concrete_uniaxial.prm";
    options->folder    = "output/bench_uniaxial";

    CLI::App &bench = *program.add_subcommand("bench", "Speed against error, as a table and a figure");
    bench.require_subcommand(1);
    add_calibration_bench(bench, chosen);
    add_confined_bench(bench, chosen);
    add_conservation_bench(bench, chosen);
    add_continuum_bench(bench, chosen);
    add_homogenise_bench(bench, chosen);
    add_mesoscale_bench(bench, chosen);
    add_mortar_bench(bench, chosen);
    add_multiscale_bench(bench, chosen);
    add_peridynamics_bench(bench, chosen);
    add_sequential_bench(bench, chosen);
    add_quasi_static_bench(bench, chosen);
    add_ranks_bench(bench, chosen);
    add_rate_effect_bench(bench, chosen);
    add_size_effect_bench(bench, chosen);
    add_structure_bench(bench, chosen);
    add_surface_bench(bench, chosen);
    add_volume_bench(bench, chosen);
    CLI::App &command =
      *bench.add_subcommand("uniaxial", "Strengths and modulus over time step, loading rate and particle size");
    command.add_option("scene", options->scene, "Scene of kind uniaxial; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    command.add_option("--seeds", options->seeds, "Packings per case; default: 1")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
    command.add_flag("--quick", options->quick, "Fewer and cheaper cases");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_uniaxial_bench(*options);
      };
    });
  }
} // namespace apps
