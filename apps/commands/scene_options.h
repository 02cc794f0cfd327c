#pragma once

#include "apps/process/threads.h"
#include "apps/scene/kinds/read_scene.h"

#include <CLI/App.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** What `run` and `check` share: the scene, changes to it, and how many threads. */
  struct SceneOptions
  {
    std::string              scene;
    std::vector<std::string> overrides;
    int                      threads = 0; ///< 0: see use_threads()
  };

  void add_scene_options(CLI::App &command, SceneOptions &options);

  /** Options -s; each takes one text. */
  void add_overrides(CLI::App &command, std::vector<std::string> &overrides, const std::string &meaning);

  /** Option -o of what is measured. @param folder its default @param holds "the table and the figure" */
  void add_bench_folder(CLI::App              &command,
                        std::filesystem::path &folder,
                        const std::string     &holds = "the table and the figure");

  /** Option --no-cache, of whatever makes packings. */
  void add_no_cache(CLI::App &command);

  /** Option --threads. */
  void add_threads(CLI::App &command, int &threads);

  /** What reading a scene has noted, for the terminal. */
  void print_notes(const CheckedScene &scene);

  /** @throws base::InputError when mpirun has started several processes and the kind of the scene runs in one. */
  void refuse_idle_ranks(const CheckedScene &scene);
} // namespace apps
