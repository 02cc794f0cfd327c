#pragma once

#include "apps/results/run_result.h"
#include "apps/scene/kinds/read_scene.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace python
{
  /** How a scene is run from Python. */
  struct RunChoice
  {
    std::string folder;         ///< for results; "": no file is written
    bool        resume = false; ///< go on from the checkpoint of an interrupted run in the folder
    pybind11::object
      on_sample; ///< called with a dictionary for every row of the series; a true answer stops the run. None: nothing
  };

  /** @throws base::InputError for a scene of several runs */
  apps::RunRequest request_for(const apps::CheckedScene &scene, const RunChoice &choice);

  /**
   * Run a scene to its end, or until the callback or Ctrl-C stops it; other threads of Python go on meanwhile. After Ctrl-C the state is
   * saved, where there is a folder, as in the terminal, and KeyboardInterrupt is raised.
   * @param changes "Section/Entry=value" each @throws as apps::Scene::run(), and what the callback raises
   */
  std::shared_ptr<apps::RunResult>
  run_scene(const std::string &file, const std::vector<std::string> &changes, const RunChoice &choice);
} // namespace python
