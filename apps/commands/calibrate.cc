#include "apps/commands/command.h"
#include "apps/commands/scene_options.h"
#include "apps/commands/study_options.h"
#include "apps/process/exit_status.h"
#include "apps/process/interrupt.h"
#include "apps/studies/calibration.h"
#include "apps/studies/folder_lock.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/errors.h"
#include "postprocess/files/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace apps
{
  namespace
  {
    void make_calibration_folders(const StudyOptions &options)
    {
      std::error_code error;
      for (const char *part : {"journal", "runs"})
        {
          if (options.restart)
            std::filesystem::remove_all(options.folder / part, error);
          std::filesystem::create_directories(options.folder / part, error);
          if (error)
            throw postprocess::OutputError((options.folder / part).string() +
                                           ": the folder cannot be made: " + error.message() + ".");
        }
    }

    void write_calibration(const CalibrationFile       &file,
                           const CalibrationRuns       &runs,
                           const Calibration           &found,
                           const std::filesystem::path &folder)
    {
      for (std::size_t target = 0; target < file.targets.size(); ++target)
        if (file.targets[target].is_curve())
          postprocess::write_text(folder / (file.targets[target].name + ".csv"),
                                  curve_csv_of(file, runs, found, target));
      write_report(file, runs, found, folder);
      postprocess::write_text(folder / "constants.prm", prm_of(file, found));
      postprocess::write_json(folder / "calibration.json", json_of(file, runs, found));
    }

  } // namespace

  int run_calibration_file(StudyCommand command)
  {
    const auto file        = read_calibration(command.file, command.overrides);
    command.options.folder = command.folder.empty() ? file->output_folder : command.folder;
    CalibrationRuns                  runs(*file, command.options);
    std::unique_ptr<CalibrationRuns> cheap;
    if (file->cheap.exists())
      cheap = std::make_unique<CalibrationRuns>(*file, command.options, Fidelity::cheap);
    make_calibration_folders(command.options);
    const FolderLock lock(command.options.folder / "journal" / "lock");
    catch_interrupts();
    try
      {
        runs.measure();
        if (cheap)
          cheap->measure();
        Calibration found = calibrate(*file, runs, cheap.get());
        if (file->posterior.runs > 0)
          found.posterior = posterior_of(*file, runs, found);
        write_calibration(*file, runs, found, command.options.folder);
        fmt::print("{}\nwritten to {}: report.html, calibration.json, curves, and each run below runs\n",
                   words_of(*file, runs, found), command.options.folder.string());
        return exit_success;
      }
    catch (const CalibrationInterrupted &)
      {
        fmt::print(stderr, "interrupted; runs that are done are kept. The same command goes on with the others.\n");
        return exit_interrupted;
      }
  }

  void add_calibrate(CLI::App &program, Action &chosen)
  {
    const auto command = std::make_shared<StudyCommand>();
    CLI::App  &sub =
      *program.add_subcommand("calibrate", "Constants that make runs give what was measured, and how sure they are");
    sub.footer("Runs that are done are kept in the folder: whatever ends a calibration, the same command goes on "
               "without repeating one.");
    sub.add_option("calibration", command->file, "Calibration file")->required()->type_name("CALIBRATION.prm");
    add_overrides(sub, command->overrides, "Change an entry of the file, -s \"Search/Step=0.01\"; repeatable");
    add_study_options(sub, "calibration", command->folder, command->options);
    sub.callback([command, &chosen] { chosen = [command] { return run_calibration_file(*command); }; });
  }
} // namespace apps
