#include "apps/bench/beygi_mixes.h"
#include "apps/bench/mesoscale.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_mesoscale_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<MesoscaleBench> command(
      bench, "mesoscale",
      "Six published concretes of aggregates in mortar, beside their experiment and a published simulation");
    command.scene("scene", &MesoscaleBench::scene, "Scene of kind uniaxial with a mix");
    command.overrides();
    command.threads(0);
    command.no_cache();
    command.folder();
    std::vector<std::string> names;
    for (const beygi::Mix &mix : beygi::mixes())
      names.push_back(mix.name);
    command.option("--geometries", &MesoscaleBench::geometries, "N", "Of aggregates, per mix; default: 3")
      .check(CLI::Range(1, 1000));
    command.list("--mixes", &MesoscaleBench::mixes, "NAME,...", "Which, beside those with 9.5 mm; default: all")
      .check(CLI::IsMember(names));
    command
      .list("--ductility", &MesoscaleBench::ductility, "F,...",
            "Of the interface over that of the mortar; default: 0.1 0.05")
      .check(CLI::PositiveNumber);
    command
      .option(
        "--work-until", &MesoscaleBench::work_until, "F",
        "Part of the strength that the stress falls to where the work of fracture ends; published: 0.2; default: 0.05")
      .check(CLI::Range(1e-3, 0.9));
    command.flag("--quick", &MesoscaleBench::quick, "One geometry of l-9.5 and l-19 each, with the first ductility");
    command.runs(chosen, run_mesoscale_bench);
  }
} // namespace apps
