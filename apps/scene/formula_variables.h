#pragma once

#include <string>

namespace apps
{
  /** Whether a place, x, y or z, occurs in a formula. @pre Expression finds no fault with it; nothing is a formula, too */
  bool varies_in_space(const std::string &formula);
} // namespace apps
