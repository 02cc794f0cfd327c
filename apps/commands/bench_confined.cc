#include "apps/bench/confined.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_confined_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<ConfinedBench> command(
      bench, "confined", "Strength of a specimen over the pressure around it: a biaxial or triaxial family");
    command.scene("scene", &ConfinedBench::scene, "Scene of kind particles with a biaxial or triaxial test");
    command.overrides();
    command.threads(0);
    command.no_cache();
    command.folder();
    command
      .list("--pressures", &ConfinedBench::pressures, "P,...", "Confining pressures [Pa]; default: 0.5e6 2e6 5e6 10e6")
      .check(CLI::PositiveNumber);
    command.runs(chosen, run_confined_bench);
  }
} // namespace apps
