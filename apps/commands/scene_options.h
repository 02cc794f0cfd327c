#pragma once

#include "apps/scene/load.h"

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** What `run` and `check` share: the scene, changes to it, and how many threads. */
  struct SceneOptions
  {
    std::string              scene;
    std::vector<std::string> overrides;
    int                      threads = 0; ///< 0: as many as OpenMP chooses (all cores, or OMP_NUM_THREADS)
  };

  void add_scene_options(CLI::App &command, SceneOptions &options);

  /** Options -s; each takes one text. */
  void add_overrides(CLI::App &command, std::vector<std::string> &overrides, const std::string &meaning);

  /** Option --threads. */
  void add_threads(CLI::App &command, int &threads);

  /** @throws dem::InputError when mpirun has started several processes and the kind of the scene runs in one. */
  void refuse_idle_ranks(const LoadedScene &scene);

  /** Let OpenMP use the given number of threads; 0 leaves it as it is. */
  void use_threads(int threads);
} // namespace apps
