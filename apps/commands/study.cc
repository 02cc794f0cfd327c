#include "apps/commands/command.h"
#include "apps/commands/part_option.h"
#include "apps/commands/scene_options.h"
#include "apps/commands/study_options.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/process/mpi_session.h"
#include "apps/studies/run_study.h"
#include "base/errors.h"

#include <memory>

namespace apps
{
  namespace
  {
    /** Under mpirun each process takes a part, and one run at a time: the processors are shared already. */
    void take_part_of_ranks(StudyOptions &options)
    {
      if (launched_ranks() == 1)
        return;
      if (options.parts > 1)
        throw base::InputError("command line: under mpirun the processes are the parts: no --part.");
      options.part  = launched_rank() + 1;
      options.parts = launched_ranks();
      if (options.processes == 0)
        options.processes = 1;
    }
  } // namespace

  int run_study_file(StudyCommand command)
  {
    take_part_of_ranks(command.options);
    const auto      file   = read_study(command.file, command.overrides);
    const StudyPlan plan   = plan_of(*file);
    command.options.folder = command.folder.empty() ? file->output_folder : command.folder;
    catch_interrupts();
    return run_study(*file, plan, command.options);
  }

  void add_study(CLI::App &program, Action &chosen)
  {
    const auto command = std::make_shared<StudyCommand>();
    CLI::App  &sub =
      *program.add_subcommand("study", "Run a scene with its constants varied by a design, into one table");
    sub.footer("Runs that are done are kept in the folder: whatever ends a study, the same command goes on with the "
               "others.\nA run that fails is a row of the table without a result, and a comment that says why.");
    sub.add_option("study", command->file, "Study file")->required()->type_name("STUDY.prm");
    add_overrides(sub, command->overrides, "Change an entry of the study, -s \"Design/Runs=40\"; repeatable");
    add_study_options(sub, "study", command->folder, command->options);
    add_part(sub, command->options.part, command->options.parts,
             "Only the third of forty parts, for jobs of a batch array that share the folder; the last one writes the "
             "table");
    sub.add_flag("--no-cache", command->options.no_cache, "Make every packing anew");
    sub.callback([command, &chosen] { chosen = [command] { return run_study_file(*command); }; });
  }
} // namespace apps
