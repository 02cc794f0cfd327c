#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench size-effect`. */
  struct SizeEffectBench
  {
    std::string              scene = "apps/scenes/size_effect.prm";
    std::vector<std::string> overrides; ///< of the scene
    std::filesystem::path    folder;
    std::vector<int>         sizes        = {1, 2, 4, 8}; ///< over that of the scene
    std::vector<int>         particles    = {1, 2};       ///< of them, beams all of particles beside
    int                      geometries   = 3;            ///< of particles and aggregates, per size
    int                      calibrated   = 2;            ///< size from which alone the others are predicted
    bool                     notched_only = false;        ///< no beams without a notch
    bool                     restart      = false;        ///< throw away what the folder holds
    int                      part = 1, parts = 1;         ///< of processes that share the folder: every parts-th beam
    bool                     quick = false;               ///< one geometry of sizes 1 and 2, with a notch
  };

  /**
   * Beams of similar shape with particles of one mortar and one mix, with a notch and without: strengths over the size, fitted by laws of size
   * effect, and predicted from one size alone (doc/theory/size-effect.md). The scene is of kind structure, with the names of sections that
   * apps/scenes/size_effect.prm has.
   *
   * Beams that the folder holds, from an interrupted bench or from another part, are not broken again. Once all are there, they are written to
   * size_effect.csv, .md and .png.
   * @return exit status. @throws base::InputError, postprocess::OutputError
   */
  int run_size_effect_bench(const SizeEffectBench &bench);
} // namespace apps
