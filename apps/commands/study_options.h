#pragma once

#include "apps/studies/run_study.h"

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** A study or a calibration as the command line names it. */
  struct StudyCommand
  {
    std::string              file, folder; ///< folder "": the file's own
    std::vector<std::string> overrides;
    StudyOptions             options;
  };

  /** What `study` and `calibrate` do. @return exit status */
  int run_study_file(StudyCommand command);
  int run_calibration_file(StudyCommand command);

  /** -o, --processes and --restart of a command that makes many runs. @param of "study", for the help */
  void add_study_options(CLI::App &command, const std::string &of, std::string &folder, StudyOptions &options);
} // namespace apps
