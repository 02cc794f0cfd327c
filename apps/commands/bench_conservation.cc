#include "apps/bench/conservation.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_conservation_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<ConservationBench> command(
      bench, "conservation", "Every way of coupling in every motion: momenta, energy with its order in the step, cost");
    command.threads(1);
    command.folder("the table");
    command.flag("--quick", &ConservationBench::quick, "One method of each kind, rotation and impact only");
    command.runs(chosen, run_conservation_bench);
  }
} // namespace apps
