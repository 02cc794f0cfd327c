#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench multiscale`. */
  struct MultiscaleBench
  {
    std::string scene = "apps/scenes/cells_in_beam.prm"; ///< of kind continuum, in the plane, with cells
    std::string plate =
      "apps/scenes/cells_at_hole.prm";  ///< likewise; coarsened, and driven in equilibrium and in motion
    std::vector<std::string> overrides; ///< of it
    std::filesystem::path    folder;
    bool                     quick = false; ///< small cells, and a short part of the curve only
  };

  /**
   * Cells behind integration points: what one costs (elastic, damaging, many of them on threads), and a scene with cells where they are needed
   * against the same with cells everywhere, by promotion threshold, size and tolerance of the cells: error of the curve over cost.
   *
   * And a small structure whose cells are in equilibrium against the same in motion, driven slower and slower.
   *
   * The scene has a group `solid` of cells and a reaction at a support `load` along y, the plate one at a boundary `right` along x. Written after every case to multiscale.csv and
   * multiscale.md, at the end to multiscale.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_multiscale_bench(const MultiscaleBench &bench);
} // namespace apps
