#pragma once

#include "apps/studies/study_plan.h"

#include <filesystem>
#include <string>

namespace apps
{
  struct StudyOptions
  {
    std::filesystem::path folder;
    int                   processes = 0;       ///< at a time; 0: as many as there are processors and memory for
    int                   part = 1, parts = 1; ///< of a batch array: every parts-th run from this one on
    bool                  restart  = false;
    bool                  no_cache = false;
  };

  /**
   * Run what is not in the journal yet, and write table.csv once every run is.
   * @return exit status: 0, or 130 after an interrupt
   * @throws base::InputError, also for a response that the first run that succeeds does not have; postprocess::OutputError
   */
  int run_study(const StudyFile &study, const StudyPlan &plan, const StudyOptions &options);

  /** How many runs go on at a time. */
  int processes_of(const StudyFile &study, const StudyOptions &options);
} // namespace apps
