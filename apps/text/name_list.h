#pragma once

#include <string>
#include <vector>

namespace apps
{
  /** Names separated by commas, without the blanks around them. */
  std::vector<std::string> names_in(const std::string &text);
} // namespace apps
