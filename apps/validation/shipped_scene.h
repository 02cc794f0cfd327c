#pragma once

#include <string>

namespace apps
{
  /** Text of a scene of apps/scenes that the program has within it (apps/CMakeLists.txt). @throws std::out_of_range for another */
  const std::string &shipped_scene(const std::string &name);
} // namespace apps
