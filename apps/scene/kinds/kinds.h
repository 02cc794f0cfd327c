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

  /** Every kind of scene there is; a new one of the program is one line in all.cc. */
  const std::vector<SceneKind> &scene_kinds();

  /** One more, of a program that uses this library; before scenes are read. @throws std::invalid_argument for a name that is taken */
  void add_scene_kind(const SceneKind &kind);
} // namespace apps
