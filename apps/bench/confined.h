#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench confined`. */
  struct ConfinedBench
  {
    std::string              scene = "apps/scenes/rock_triaxial.prm";
    std::vector<std::string> overrides;
    std::filesystem::path    folder;
    std::vector<double>      pressures = {0.5e6, 2e6, 5e6, 10e6}; ///< [Pa], > 0
  };

  /**
   * A family of tests under pressure from the sides: the scene (kind particles, biaxial or triaxial compression) at each pressure, its
   * strength over the pressure, and the straight line of Mohr and Coulomb through it: sigma_1 = q + k p, sin phi = (k - 1)/(k + 1),
   * c = q/(2 sqrt k).
   *
   * Written after every test to confined.csv and confined.md, at the end to confined.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_confined_bench(const ConfinedBench &bench);
} // namespace apps
