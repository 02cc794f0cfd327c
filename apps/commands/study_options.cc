#include "apps/commands/study_options.h"

#include <CLI/Validators.hpp>

namespace apps
{
  void add_study_options(CLI::App &command, const std::string &of, std::string &folder, StudyOptions &options)
  {
    command
      .add_option("-o,--output", folder,
                  "Folder for the results and the runs; default: the " + of + "'s, or output/NAME")
      ->type_name("DIR");
    command
      .add_option("--processes", options.processes,
                  "Runs at a time; default: as many as there are processors and memory for")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
    command.add_flag("--restart", options.restart, "Throw away the runs that are there");
  }
} // namespace apps
