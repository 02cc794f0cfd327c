#pragma once

#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"

#include <filesystem>

namespace apps_tests
{
  /** The scene run by the library, in this process. @param folder receives what it writes */
  inline apps::RunResult run_in_process(const apps::CheckedScene &scene, const std::filesystem::path &folder)
  {
    apps::RunRequest request = apps::request_of(scene);
    request.output_folder    = folder;
    return scene.scene->run(request);
  }
} // namespace apps_tests
