#pragma once

#include <filesystem>
#include <vector>

namespace apps
{
  /** Options of `breccia bench homogenise`. */
  struct HomogeniseBench
  {
    std::filesystem::path folder;
    std::vector<int>      particles         = {500, 1000, 4000};               ///< cells of the study of solvers
    std::vector<int>      seed_particles    = {64, 125, 250, 500, 1000, 2000}; ///< cells of the study of seeds
    int                   seeds             = 8;
    double                interaction_ratio = 1.5, shear_ratio = 0.2;
    double                friction = 1;     ///< while the packings are compacted
    bool                  quick    = false; ///< cells of 64 and 125 spheres only
  };

  /**
   * Error of the relaxed stiffness against cost: of the solvers over their tolerance, for cells of several sizes (direct,
   * iterative, dynamic relaxation of the linear network, and of the explicit dem::Specimen itself); and the scatter over seeds for cells of several sizes, which is the error of taking one cell for the material.
   *
   * Cost is processor time of the six load cases, from the list of links to the stiffness. Written to homogenise.csv,
   * homogenise.md and homogenise.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_homogenise_bench(const HomogeniseBench &bench);
} // namespace apps
