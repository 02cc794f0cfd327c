#pragma once

#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "base/errors.h"

#include <array>
#include <string>
#include <vector>

namespace apps
{
  /** One case of a bench that varies a scene: what is studied, at which value, and the entries that say so. */
  struct SceneVariant
  {
    std::string              study, value;
    std::vector<std::string> changes; ///< "Section/Key=value"

    /** The scene with the user's changes, and then these. @throws base::InputError */
    CheckedScene of(const std::string &scene, std::vector<std::string> overrides) const
    {
      overrides.insert(overrides.end(), changes.begin(), changes.end());
      return read_scene(scene, overrides);
    }
  };

  /** Entries that divide the box of a continuum into so many elements along each axis. */
  std::vector<std::string> box_divisions(const std::array<int, 3> &elements);

  /** A bench refuses a scene that it cannot vary. @param why "Section/Entry: what it needs" */
  [[noreturn]] inline void refuse_scene(const CheckedScene &scene, const std::string &why)
  {
    throw base::InputError(scene.file + ": " + why);
  }

  /** The model of a bench's scene. @throws base::InputError where it is of another kind than `kind` */
  template <typename Model>
  const Model &model_of_kind(const CheckedScene &scene, const std::string &kind)
  {
    const auto *found = dynamic_cast<const SceneOf<Model> *>(scene.scene.get());
    if (!found)
      refuse_scene(scene, "Kind = " + scene.kind + ": this bench needs a scene of kind " + kind + ".");
    return found->model();
  }
} // namespace apps
