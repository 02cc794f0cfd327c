#pragma once

#include <string>

namespace apps
{
  /** One sentence on what has this name elsewhere and Breccia does not have, or has in another way; "" for anything else. */
  std::string absent(const std::string &typed);
} // namespace apps
