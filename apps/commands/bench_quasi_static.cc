#include "apps/bench/quasi_static.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_quasi_static_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<QuasiStaticBench> command(bench, "quasi-static",
                                           "Tensile strength without inertia and at falling loading rates");
    command.scene("scene", &QuasiStaticBench::scene, "Scene of kind uniaxial");
    command.overrides();
    command.folder();
    command
      .list("--rates", &QuasiStaticBench::rates, "R,R,...",
            "Strain rates of the dynamic runs [1/s]; default: 10,3,1,0.3,0.1,0.03")
      .check(CLI::PositiveNumber);
    command.flag("--quick", &QuasiStaticBench::quick, "A smaller specimen, three rates");
    command.threads(1);
    command.no_cache();
    command.runs(chosen, run_quasi_static_bench);
  }
} // namespace apps
