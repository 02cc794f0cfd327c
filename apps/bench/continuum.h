#pragma once

#include <filesystem>

namespace apps
{
  /** Options of `breccia bench continuum`. */
  struct ContinuumBench
  {
    std::filesystem::path folder;
    bool                  quick = false; ///< small meshes only, and not the million unknowns
  };

  /**
   * Finite elements: error of a manufactured solution over cost for elements, orders and solvers; unknowns per second of
   * assembly, product and explicit step beside a plain deal.II loop; a million unknowns.
   *
   * On one rank everything is measured, and written to continuum.csv (errors), continuum_rates.csv, continuum.md and
   * continuum.png. The large problem and the explicit motion are measured on any number of ranks; their rows are kept in
   * continuum_ranks.csv, one set per number of ranks, so that two runs into one folder give the speed-up.
   *
   * @return exit status. @throws postprocess::OutputError.
   */
  int run_continuum_bench(const ContinuumBench &bench);
} // namespace apps
