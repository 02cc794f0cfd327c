#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench sequential`. */
  struct SequentialBench
  {
    std::string scene =
      "apps/scenes/transfer_compression.prm"; ///< of kind sequential, particles strained between grips, continuum a box
    std::vector<std::string> overrides;
    std::filesystem::path    folder;
    bool                     quick = false;
  };

  /**
   * When a transfer pays: error of the continuation against the all-particle run, over the instant of transfer, the kernel and its
   * width, and the mesh, beside what continuation and remaining particle run cost.
   *
   * Written to sequential.csv, sequential.md and sequential.png.
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_sequential_bench(const SequentialBench &bench);
} // namespace apps
