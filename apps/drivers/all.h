#pragma once

#include "apps/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** A word for the scene entry "Kind", and what it makes. */
  struct SceneKind
  {
    std::string name, meaning;
    std::unique_ptr<Scene> (*create)();
  };

  /** Every kind of scene there is; a new one is one line in all.cc. */
  const std::vector<SceneKind> &scene_kinds();
} // namespace apps
