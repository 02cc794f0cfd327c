#include "apps/bench/continuum.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_continuum_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<ContinuumBench> command(bench, "continuum",
                                         "Finite elements over element, order and solver; beside a plain deal.II loop");
    command.folder("the tables and the figure");
    command.flag("--quick", &ContinuumBench::quick, "Small meshes only");
    command.footer("Under mpirun only the figures that depend on the ranks are measured and added to "
                   "continuum_ranks.csv of the folder.");
    command.runs(chosen, run_continuum_bench);
  }
} // namespace apps
