#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace apps
{
  /**
   * Read particle numbers, counted from 1 as users do: one or several a line, between blanks or commas; from "#" on a line is a
   * comment. @return them counted from 0, sorted
   * @throws base::InputError naming file and line: missing file, not a whole number, none of the particles there are, one twice
   */
  std::vector<std::size_t> read_particle_numbers(const std::string &file, std::size_t particles);
} // namespace apps
