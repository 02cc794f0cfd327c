#pragma once

#include <filesystem>

namespace apps
{
  /** Options of `breccia bench conservation`. */
  struct ConservationBench
  {
    std::filesystem::path folder;
    bool                  quick = false; ///< a part of the methods and motions
  };

  /**
   * What every way of coupling keeps of every motion (doc/theory/conservation.md): momentum and angular momentum of both sides together, energy that
   * no account contains with its order in the step, what the coupling itself loses, and what a window costs over the first of its kind.
   *
   * Written after every case to conservation.csv and conservation.md; no figure.
   *
   * @return exit status. @throws postprocess::OutputError
   */
  int run_conservation_bench(const ConservationBench &bench);
} // namespace apps
