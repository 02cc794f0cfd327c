#pragma once

#include <filesystem>

namespace apps
{
  /** Options of `breccia bench peridynamics`. */
  struct PeridynamicsBench
  {
    std::filesystem::path folder;
    bool                  quick = false; ///< coarse grids only
  };

  /**
   * Errors of a plate in tension and in shear, beside bonds and seconds: as the horizon shrinks with the spacing (delta), as the grid is
   * refined within a horizon of 60 mm (m), by layout, weight, calibration and correction. Then steps of relaxations beside the published
   * ones, and bond updates a second.
   *
   * Written to peridynamics.csv, .md and .png.
   *
   * @return exit status. @throws postprocess::OutputError.
   */
  int run_peridynamics_bench(const PeridynamicsBench &bench);
} // namespace apps
