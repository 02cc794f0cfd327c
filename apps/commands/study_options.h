#pragma once

#include "apps/studies/run_study.h"

#include <CLI/App.hpp>

#include <string>

namespace apps
{
  /** -o, --processes and --restart of a command that makes many runs. @param of "study", for the help */
  void add_study_options(CLI::App &command, const std::string &of, std::string &folder, StudyOptions &options);
} // namespace apps
