#pragma once

#include <string>

namespace apps_tests
{
  /**
   * A close hexagonal stack of 5 x 5 x 7 spheres of 1 mm radius, a little apart, as a text packing: enough for damage,
   * sliding and broken links, and run in about a second.
   */
  std::string stack_packing();

  /** Two spheres of 1 mm on the z axis, 2 mm apart. */
  std::string pair_packing();

  /** Section Material: the concrete of concrete_uniaxial.prm. */
  std::string material_of_concrete();

  /** Section Mix of a specimen: 30 per cent of aggregates of 4 to 6 mm. */
  std::string mix_of_two_sizes();

  /** A scene that reads the packing "packing.txt" beside it, with material_of_concrete(). */
  std::string scene_with_file();

  /** The text with its first occurrence of `from` replaced. @throws std::logic_error if there is none */
  std::string replaced(std::string text, const std::string &from, const std::string &to);

  /** Head of a scene of balls of 2500 kg/m^3 that are not bonded, whose contacts have this modulus [Pa]. */
  std::string loose_balls(const std::string &effective_modulus);
} // namespace apps_tests
