#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What `breccia bench surface` is asked. */
  struct SurfaceBench
  {
    std::string              scene;
    std::vector<std::string> overrides; ///< of the scene
    std::filesystem::path    folder;
    bool                     quick = false; ///< fewer and cheaper cases
  };

  /**
   * Error of an impact's peak force and contact time against cost, over the mesh, the step, sub-cycling, and how contacts are
   * spread. The scene is of kind coupled, on a box, and has a coupling and the known answers in its section References.
   *
   * Written after every case to surface.csv and surface.md, at the end to surface.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_surface_bench(const SurfaceBench &bench);
} // namespace apps
