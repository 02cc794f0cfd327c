#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench structure`. */
  struct StructureBench
  {
    std::string whole = "apps/scenes/bending_of_particles.prm",
                scene = "apps/scenes/bending_with_core.prm"; ///< all of particles; with a core of them
    std::vector<std::string> overrides;                      ///< of both scenes
    std::filesystem::path    folder;
    bool                     quick   = false; ///< one method only; of solvers the largest particles
    bool                     solvers = false; ///< these instead (structure_solvers.h)
  };

  /**
   * A notched beam with a core of particles against the same beam all of particles: error of peak load, and of the opening at it, over cost,
   * by method, width of the core and size of elements. The scenes are of kind structure, in space; the second has one handshake in a box, and
   * both drive a group `load` along z and have a probe `opening`.
   *
   * Written after every case to structure.csv and structure.md, at the end to structure.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_structure_bench(const StructureBench &bench);
} // namespace apps
