#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench quasi-static`. */
  struct QuasiStaticBench
  {
    std::string scene = "apps/scenes/concrete_uniaxial.prm"; ///< of kind uniaxial: material, particles, grips, damping
    std::vector<std::string> overrides;                      ///< of the scene
    std::filesystem::path    folder;
    int                      cell_particles = 500; ///< of the packing that the specimen is cropped from
    double                   edge  = 10; ///< of the specimen, 1.5 times as high, over the radius of its spheres
    std::vector<double>      rates = {10, 3, 1, 0.3, 0.1, 0.03}; ///< [1/s]
    bool                     quick = false;                      ///< smaller and faster
  };

  /**
   * Tensile strength of one small specimen, made as the scene says, along its quasi-static path, and pulled in time at falling
   * rates: the rate effect of the dynamic strengths, and the cost of avoiding it.
   *
   * Written to quasi_static.csv, quasi_static.md and quasi_static.png. @return exit status. @throws base::InputError,
   * postprocess::OutputError.
   */
  int run_quasi_static_bench(const QuasiStaticBench &bench);
} // namespace apps
