#pragma once

#include <string>

namespace apps
{
  /** Equal but for case: so are sections, entries, kinds, laws and other words of the program found. */
  bool same_name(const std::string &a, const std::string &b);
} // namespace apps
