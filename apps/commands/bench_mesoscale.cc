#include "apps/bench/beygi_mixes.h"
#include "apps/bench/mesoscale.h"
#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"

#include <CLI/Validators.hpp>

#include <memory>

namespace apps
{
  void add_mesoscale_bench(CLI::App &bench, Action &chosen)
  {
    struct Options : MesoscaleBench
    {
      int threads = 0;
    };
    const auto options = std::make_shared<Options>();
    options->scene     = "apps/scenes/mesoscale_cube.prm";
    options->folder    = "output/bench_mesoscale";
    CLI::App &command  = *bench.add_subcommand(
       "mesoscale",
       "Six published concretes of aggregates in mortar, beside their experiment and a published simulation");
    command.add_option("scene", options->scene, "Scene of kind uniaxial with a mix; default: " + options->scene)
      ->type_name("SCENE");
    add_overrides(command, options->overrides, "Set an entry of the scene; repeatable");
    add_threads(command, options->threads);
    add_no_cache(command);
    add_bench_folder(command, options->folder);
    std::vector<std::string> names;
    for (const beygi::Mix &mix : beygi::mixes())
      names.push_back(mix.name);
    command.add_option("--geometries", options->geometries, "Of aggregates, per mix; default: 3")
      ->check(CLI::Range(1, 1000))
      ->type_name("N");
    command.add_option("--mixes", options->mixes, "Which, beside those with 9.5 mm; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->type_name("NAME,...");
    command
      .add_option("--ductility", options->ductility, "Of the interface over that of the mortar; default: 0.1 0.05")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->type_name("F,...");
    command.add_flag("--quick", options->quick, "One geometry of l-9.5 and l-19 each, with the first ductility");
    command.callback([options, &chosen] {
      chosen = [options] {
        use_threads(options->threads);
        return run_mesoscale_bench(*options);
      };
    });
  }
} // namespace apps
