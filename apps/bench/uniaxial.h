#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench uniaxial`. */
  struct UniaxialBench
  {
    std::string              scene = "apps/scenes/concrete_uniaxial.prm";
    std::vector<std::string> overrides; ///< of the scene
    std::filesystem::path    folder;
    int                      seeds = 1;     ///< packings per case; their mean is taken, and their scatter shown
    bool                     quick = false; ///< fewer and cheaper cases
  };

  /**
   * Error of strengths and modulus against cost, over the time step, the loading rate and the particle size.
   *
   * Each study varies one thing about the scene; its most expensive case is the reference of its errors. Written after
   * every case to uniaxial.csv and uniaxial.md, at the end to uniaxial.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_uniaxial_bench(const UniaxialBench &bench);
} // namespace apps
