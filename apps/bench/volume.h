#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench volume`. */
  struct VolumeBench
  {
    std::string              scene = "apps/scenes/wave_transmission.prm";
    std::vector<std::string> overrides; ///< of the scene
    std::filesystem::path    folder;
    bool                     quick = false; ///< fewer wavelengths
    bool                     beam  = false; ///< `breccia bench structure` after it, into the same folder
  };

  /**
   * Energy that comes back from where particles end, that goes on and that is absorbed, over the wavelength, by every method, beside what a
   * step costs. The scene is of kind transmission; its Methods do not matter.
   *
   * Written after every case to volume.csv and volume.md, at the end to volume.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_volume_bench(const VolumeBench &bench);
} // namespace apps
