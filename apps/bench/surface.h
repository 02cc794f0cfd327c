#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench surface`. */
  struct SurfaceBench
  {
    std::vector<std::string> scenes = {"apps/scenes/hertz_impact.prm", "apps/scenes/colliding_balls.prm"};
    std::vector<std::string> overrides; ///< of the scenes
    std::filesystem::path    folder;
    bool                     quick = false; ///< fewer and cheaper cases
  };

  /**
   * Error of an impact's peak force and contact time against cost, over the mesh, the step, sub-cycling, and how contacts are
   * spread. Scenes are of kind coupled, on a box, with one coupling, or of kind continuum, of balls with one contact; both have the known answers in their
   * section References.
   *
   * Written after every case to surface.csv and surface.md, at the end to surface.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_surface_bench(const SurfaceBench &bench);
} // namespace apps
