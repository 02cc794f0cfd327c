#include "apps/bench/mortar.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_mortar_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<MortarBench> command(bench, "mortar",
                                      "Strength and modulus of a grown, jointed specimen over size of particles, "
                                      "speed, damping and elements per joint");
    command.scene("scene", &MortarBench::scene, "Scene of kind particles with Genesis and Laboratory");
    command.overrides();
    command.threads(0);
    command.folder();
    command.flag("--quick", &MortarBench::quick, "Fewer cases");
    command.flag("--static-strength", &MortarBench::static_strength,
                 "Follow equilibria without inertia to failure, too: for small windows");
    command.flag("--constants", &MortarBench::constants,
                 "Instead: what each constant of the joints does to strength and modulus, beside what is published");
    command.runs(chosen, run_mortar_bench);
  }
} // namespace apps
