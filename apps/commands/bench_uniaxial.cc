#include "apps/bench/uniaxial.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_uniaxial_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<UniaxialBench> command(bench, "uniaxial",
                                        "Strengths and modulus over time step, loading rate and particle size");
    command.scene("scene", &UniaxialBench::scene, "Scene of kind uniaxial");
    command.overrides();
    command.threads(0);
    command.no_cache();
    command.folder();
    command.option("--seeds", &UniaxialBench::seeds, "N", "Packings per case; default: 1").check(CLI::Range(1, 1000));
    command.flag("--quick", &UniaxialBench::quick, "Fewer and cheaper cases");
    command.runs(chosen, run_uniaxial_bench);
  }
} // namespace apps
