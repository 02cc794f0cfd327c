#include "apps/bench/scene_variant.h"

#include <fmt/format.h>

namespace apps
{
  std::vector<std::string> box_divisions(const std::array<int, 3> &elements)
  {
    std::vector<std::string> changes;
    for (std::size_t axis = 0; axis < elements.size(); ++axis)
      changes.push_back(fmt::format("Continuum/Mesh/Box/Divisions {}={}", "xyz"[axis], elements[axis]));
    return changes;
  }
} // namespace apps
