#pragma once

#include "apps/results/run_request.h"
#include "apps/scene/scene.h"
#include "apps/scene/section.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** A scene as read: complete, and every value within its range. */
  struct CheckedScene
  {
    std::string              file;           ///< as typed
    std::string              kind;           ///< entry "Kind"
    std::string              output_folder;  ///< entry "Output folder"
    bool                     report = false; ///< entry "Output/Report"
    std::vector<std::string> overrides;      ///< as typed
    std::vector<std::string> notes;          ///< of old names in it (apps/scene/renamed.h)
    std::int64_t replicates = 1; ///< entry "Replicates": runs with seeds of their own (apps/studies/replicates.h)
    std::unique_ptr<Section> root;
    std::unique_ptr<Scene>   scene;
  };

  /**
   * Read a scene file, apply the overrides ("Section/Key=value") and check everything that can be without building
   * the model.
   * @throws base::InputError.
   */
  CheckedScene read_scene(const std::string &file, const std::vector<std::string> &overrides);

  /** The request for a run of the scene, without resuming and the changes as typed. */
  RunRequest request_of(const CheckedScene &scene);

  /** The files that entries of a scene name, or of a study; those that are missing are refused where they are read. */
  std::vector<InputFile> inputs_of(const Section &root);

  /** The parameters of a kind, unread: what `breccia describe` shows. @throws base::InputError for an unknown kind. */
  CheckedScene declare_scene(const std::string &kind);
} // namespace apps
