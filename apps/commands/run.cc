#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/commands/study_options.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/results/run_files.h"
#include "apps/results/run_report.h"
#include "apps/results/run_result.h"
#include "apps/results/terminal.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/reader.h"
#include "apps/specimens/cache_folder.h"
#include "apps/studies/replicates.h"
#include "apps/studies/study_file.h"
#include "base/errors.h"

#include <omp.h>

#include <memory>

namespace apps
{
  namespace
  {
    struct RunOptions : SceneOptions
    {
      std::string output_folder;
      bool        resume = false, restart = false;
    };

    /** A study is many runs, and goes on by itself. */
    StudyCommand study_command(const RunOptions &options)
    {
      if (options.threads > 0)
        throw base::InputError("command line: --threads: a study says itself how many each of its runs has "
                               "(-s \"Threads per run=2\").");
      StudyCommand command{options.scene, options.output_folder, options.overrides, {}};
      command.options.restart  = options.restart;
      command.options.no_cache = !packing_cache_folder();
      return command;
    }

    int run(const RunOptions &options)
    {
      if (const FileOf kind = kind_of_file(options.scene); kind != FileOf::scene)
        return kind == FileOf::study ? run_study_file(study_command(options)) :
                                       run_calibration_file(study_command(options));
      use_threads(options.threads);
      std::vector<std::string> overrides = options.overrides;
      if (!options.output_folder.empty())
        overrides.push_back("Output folder=" + options.output_folder);
      const CheckedScene scene = read_scene(options.scene, overrides);
      print_notes(scene);
      refuse_idle_ranks(scene);
      if (scene.replicates > 1 && launched_ranks() > 1)
        scene.root->refuse(
          "Replicates", "several runs are made by one process, which starts the others; mpirun has started several.");
      catch_interrupts();

      RunRequest request = request_of(scene);
      request.restart    = options.restart;
      if (options.resume)
        ask_to_go_on(request);
      request.overrides = options.overrides;
      if (scene.replicates > 1)
        return run_replicates(
          scene, request,
          {scene.output_folder, options.overrides, omp_get_max_threads(), options.restart, !packing_cache_folder()});
      RunReport report(request);
      Terminal  terminal;
      if (scene.report)
        request.observers.push_back(&report);
      request.observers.push_back(&terminal); // lists what the folder holds
      int status = exit_success;
      with_places(*scene.root, [&] { status = scene.scene->run(request).exit_status(); });
      return status;
    }
  } // namespace

  void add_run(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<RunOptions>();
    CLI::App  &command = *program.add_subcommand("run", "Run a scene and write its results");
    command.footer(
      "Results of a complete run stand in the folder: summary.json, series.csv, figures, .pvd files for "
      "ParaView, and\n"
      "scene.prm with every entry. Until then they grow in its sub-folder \"running\", and results of an "
      "earlier run stay\n"
      "as they are. Ctrl-C saves the state there; --resume goes on to the same bits.\n"
      "Replicates of a scene stand below the sub-folder \"runs\"; those that are done are never repeated.\n"
      "Exit status: 0 done, 1 the computation failed, 2 something given is wrong or cannot be written, "
      "130 interrupted.");
    add_scene_options(command, *options);
    command
      .add_option("-o,--output", options->output_folder, "Folder for the results; default: the scene's, or output/NAME")
      ->type_name("DIR");
    command.add_flag("--resume", options->resume,
                     "Go on from the checkpoint that an interrupted run left in the folder");
    command
      .add_flag("--restart", options->restart,
                "Start afresh where an interrupted run left a checkpoint, which is thrown away")
      ->excludes("--resume");
    command.callback([options, &chosen] { chosen = [options] { return run(*options); }; });
  }
} // namespace apps
