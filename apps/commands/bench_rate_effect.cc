#include "apps/bench/rate_effect.h"
#include "apps/commands/bench_command.h"

namespace apps
{
  void add_rate_effect_bench(CLI::App &bench, Action &chosen)
  {
    BenchCommand<RateEffectBench> command(bench, "rate-effect",
                                          "Strength over the rate of strain, beside the fib Model Code");
    command.scene("scene", &RateEffectBench::scene, "Scene of kind uniaxial");
    command.overrides();
    command.folder();
    command.list("--rates", &RateEffectBench::rates, "R,R,...", "Rates of strain [1/s]; default: 1e-6 to 100")
      .check(CLI::PositiveNumber);
    command.flag("--quick", &RateEffectBench::quick, "Four rates");
    command.threads(1);
    command.no_cache();
    command.runs(chosen, run_rate_effect_bench);
  }
} // namespace apps
