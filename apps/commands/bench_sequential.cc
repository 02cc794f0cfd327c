#include "apps/bench/sequential.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_sequential_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<SequentialBench> command(
      bench, "sequential", "Continuations against the all-particle run over instant of transfer, kernel and mesh");
    command.scene("scene", &SequentialBench::scene, "Scene of kind sequential");
    command.overrides();
    command.threads(0);
    command.no_cache();
    command.folder();
    command.flag("--quick", &SequentialBench::quick, "Fewer kernels and meshes");
    command.runs(chosen, run_sequential_bench);
  }
} // namespace apps
