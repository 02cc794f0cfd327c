#include "apps/commands/scene_options.h"

#include "apps/process/mpi_session.h"
#include "apps/specimens/packing_cache.h"
#include "base/errors.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <cstdio>

namespace apps
{
  void add_scene_options(CLI::App &command, SceneOptions &options)
  {
    command.add_option("scene", options.scene, "Scene file (.prm or .json)")->required()->type_name("SCENE");
    add_overrides(command, options.overrides, "Set an entry of the scene, e.g. -s \"Time/Damping=0.2\"; repeatable");
    add_threads(command, options.threads);
    add_no_cache(command);
  }

  void add_overrides(CLI::App &command, std::vector<std::string> &overrides, const std::string &meaning)
  {
    command.add_option("-s,--set", overrides, meaning)->type_name("KEY=VALUE")->allow_extra_args(false);
  }

  void add_bench_folder(CLI::App &command, std::filesystem::path &folder, const std::string &holds)
  {
    command.add_option("-o,--output", folder, "Folder for " + holds + "; default: " + folder.string())
      ->type_name("DIR");
  }

  void add_no_cache(CLI::App &command)
  {
    command.add_flag_callback("--no-cache", do_without_packing_cache,
                              "Make generated packings anew; otherwise those made before are taken from, and new ones "
                              "kept in, breccia/packings in XDG_CACHE_HOME or ~/.cache");
  }

  void add_threads(CLI::App &command, int &threads)
  {
    command
      .add_option("--threads", threads,
                  "Threads to use; default: OMP_NUM_THREADS, or one per processor that is not busy")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  }

  void print_notes(const CheckedScene &scene)
  {
    if (launched_rank() > 0)
      return;
    for (const std::string &note : scene.notes)
      fmt::print(stderr, "note: {}\n", note);
  }

  void refuse_idle_ranks(const CheckedScene &scene)
  {
    if (launched_ranks() > 1 && !scene.scene->shares_ranks())
      throw base::InputError(fmt::format(
        "{}: Kind = {}: runs in one process, and mpirun has started {}. Use --threads; "
        "only scenes of kind cell, continuum, coupled, homogenisation, particles, quasi_static, structure and uniaxial "
        "share their work among processes.",
        scene.file, scene.kind, launched_ranks()));
  }
} // namespace apps
