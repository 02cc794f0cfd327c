#include "apps/bench/peridynamics.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_peridynamics_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<PeridynamicsBench> command(
      bench, "peridynamics",
      "Errors of a plate in tension and shear over its grid, steps of relaxations, bond updates a second");
    command.threads(1);
    command.folder();
    command.flag("--quick", &PeridynamicsBench::quick, "Coarse grids only, and no relaxations");
    command.runs(chosen, run_peridynamics_bench);
  }
} // namespace apps
