#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench rate-effect`. */
  struct RateEffectBench
  {
    std::string scene =
      "apps/scenes/rate_effect.prm";    ///< of kind uniaxial, whose law has a Damage time or a Plastic time
    std::vector<std::string> overrides; ///< of the scene
    std::filesystem::path    folder;
    std::vector<double>      rates = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1, 3, 10, 30, 100}; ///< ascending [1/s]
    bool                     quick = false;                                                   ///< four rates
  };

  /**
   * Strength over the rate of strain, of each test of the scene: as the law has it, with inertia alone, and by the fib Model Code 2010
   * (doc/theory/cpm-options.md, 6). Rates below that of the scene are run at it, with times of the law that are shorter or longer by as much.
   *
   * Written to rate_effect.csv, rate_effect.md and rate_effect.png. @return exit status. @throws base::InputError,
   * postprocess::OutputError.
   */
  int run_rate_effect_bench(const RateEffectBench &bench);

  /** Strength at a rate of strain over that at rest, fib Model Code 2010, 5.1.11.2. @param rate [1/s], magnitude */
  double fib_strength_ratio(bool tension, double rate);
} // namespace apps
