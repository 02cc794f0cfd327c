#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** Options of `breccia bench mortar`. */
  struct MortarBench
  {
    std::string              scene = "apps/scenes/mortar_window.prm";
    std::vector<std::string> overrides;
    std::filesystem::path    folder;
    bool                     quick = false; ///< fewer cases
    /** Strength along equilibria too, which takes a linear solution or more for every element that breaks. */
    bool static_strength = false;
    /** Instead, the effect of each constant: see mortar_constants.h. */
    bool constants = false;
  };

  /**
   * A bonded specimen that grows in its vessel and is crushed by platens: strength and modulus over the scale of its particles, the speed of
   * the platens, damping and the elements of a joint, beside the cost, and the modulus, on request also the strength, without inertia. The scene is of kind particles, with
   * Specimen/Source = genesis, flat joints and a uniaxial compression in section Laboratory.
   *
   * Written after every case to mortar.csv and mortar.md, at the end to mortar.png.
   *
   * @return exit status. @throws base::InputError, postprocess::OutputError.
   */
  int run_mortar_bench(const MortarBench &bench);
} // namespace apps
