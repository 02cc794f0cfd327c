#pragma once

#include "apps/scene/assignment.h"

#include <istream>
#include <string>
#include <vector>

namespace apps
{
  /** Sections within sections: far more than any kind of scene has, and few enough to be read at once. */
  constexpr std::size_t deepest_section = 32;

  /**
   * Which entries a `.prm` file sets and which sections it opens, and on which lines; the values are left to deal.II.
   *
   * deal.II's ParameterHandler knows what a file says but not where it says it. This scan finds the places, and refuses
   * what is not a line of a parameter file.
   *
   * @throws base::InputError naming the line, for a line of no known form, unbalanced or too deep sections, an entry set twice.
   */
  std::vector<Assignment> entries_of_prm(std::istream &text, const std::string &file);

  /** The same for a JSON file: objects are sections, texts, numbers, true and false are values. */
  std::vector<Assignment> entries_of_json(std::istream &text, const std::string &file);
} // namespace apps
