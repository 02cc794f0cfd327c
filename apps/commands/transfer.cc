#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/process/interrupt.h"
#include "apps/results/run_files.h"
#include "apps/results/run_report.h"
#include "apps/results/run_result.h"
#include "apps/results/terminal.h"
#include "apps/runs/sequential/run.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/reader.h"
#include "apps/scene/scene_of.h"

#include <memory>

namespace apps
{
  namespace
  {
    struct TransferCommand : SceneOptions
    {
      std::string output_folder;
      bool        identify = false, resume = false, restart = false;
    };

    int transfer(const TransferCommand &options)
    {
      use_threads(options.threads);
      std::vector<std::string> overrides = options.overrides;
      if (!options.output_folder.empty())
        overrides.push_back("Output folder=" + options.output_folder);
      if (options.identify)
        overrides.push_back("Transfer/Mapping law/Law=identify");
      const CheckedScene scene      = read_scene(options.scene, overrides);
      const auto        *sequential = dynamic_cast<const SceneOf<SequentialModel> *>(scene.scene.get());
      if (!sequential)
        throw base::InputError(scene.file + ": Kind = " + scene.kind +
                               ": a transfer wants a scene of kind sequential.");
      print_notes(scene);
      refuse_idle_ranks(scene);
      catch_interrupts();

      RunRequest request = request_of(scene);
      request.restart    = options.restart;
      if (options.resume)
        ask_to_go_on(request);
      request.command   = options.identify ? "transfer --identify" : "transfer";
      request.overrides = options.overrides;
      RunReport report(request);
      Terminal  terminal;
      if (scene.report)
        request.observers.push_back(&report);
      request.observers.push_back(&terminal); // lists what the folder holds
      int status = 0;
      with_places(*scene.root, [&] {
        const SequentialModel &model = sequential->model();
        status = (options.identify ? apps::identify(model, request) : transfer_only(model, request)).exit_status();
      });
      return status;
    }
  } // namespace

  void add_transfer(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<TransferCommand>();
    CLI::App  &command =
      *program.add_subcommand("transfer", "Discrete states become initial states of a continuum, without going on");
    command.footer("The scene is of kind sequential; \"breccia run\" does the same and carries on with the continuum. "
                   "For ParaView:\n"
                   "transfer.pvd shows particles, integration points and mesh with the tensors before and after.");
    add_scene_options(command, *options);
    command
      .add_option("-o,--output", options->output_folder, "Folder for the results; default: the scene's, or output/NAME")
      ->type_name("DIR");
    command.add_flag("--resume", options->resume, "Go on from what an interrupted transfer left in the folder");
    command.add_flag("--identify", options->identify,
                     "Only find the constants of the mapping law: strain the scene's particles to past their peak, and "
                     "compare with one element of its continuum");
    command
      .add_flag("--restart", options->restart,
                "Start afresh where an interrupted run left a checkpoint, which is thrown away")
      ->excludes("--resume");
    command.callback([options, &chosen] { chosen = [options] { return transfer(*options); }; });
  }
} // namespace apps
