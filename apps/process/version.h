#pragma once

#include <string>

namespace apps
{
  /** Version of the program, with the commit it was built from where that is known: "0.1.0 (1a2b3c4)". */
  std::string version();
} // namespace apps
