#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench mesoscale`. */
  struct MesoscaleBench
  {
    std::string              scene = "apps/scenes/mesoscale_cube.prm"; ///< of kind uniaxial, with a mix
    std::vector<std::string> overrides;                                ///< of the scene
    std::filesystem::path    folder;
    int                      geometries = 3; ///< of aggregates, per mix
    std::vector<std::string> mixes;          ///< names of those to take; empty: all six
    bool                     quick = false;  ///< one geometry of l-9.5 and l-19 each, with the first of these
    /// Of the interface over that of the mortar, in the two published sets of factors.
    std::vector<double> ductility = {0.1, 0.05};
    /// Of the strength in tension: work of fracture is counted until the stress is less for good. Published is what is done until 0.2.
    double work_until = 0.05;
  };

  /**
   * The six concretes of Beygi et al. (2014): their moduli, strengths and work of fracture over those with the smallest aggregates, beside the
   * experiment and a published simulation. Particles, mortar, factors and loading are those of the scene; geometries are by seeds of the mix.
   *
   * Written to mesoscale.csv (a row per geometry), mesoscale_ratios.csv (a row per ratio, with its band and whether it is within), mesoscale.md
   * and mesoscale.png. @return exit status. @throws base::InputError,
   * postprocess::OutputError.
   */
  int run_mesoscale_bench(const MesoscaleBench &bench);
} // namespace apps
