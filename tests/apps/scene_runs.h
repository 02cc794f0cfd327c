#pragma once

#include "postprocess/files/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace apps_tests
{
  /** What a run of particles, alone or beside a solid, left behind. */
  struct Results
  {
    nlohmann::json        summary;
    postprocess::CsvTable series;

    double figure(const char *probe, const char *when) const;
    double balance_error() const;
  };

  /** What a run wrote into this folder. */
  nlohmann::json summary_in(const std::filesystem::path &folder);

  /** `breccia <command> <scene>` with these entries changed; a run leaves the folder "results". */
  Outcome outcome_of(const ScratchFolder            &folder,
                     const std::string              &command,
                     const std::string              &scene,
                     const std::vector<std::string> &changes);

  /** Each of these commands refuses the scene with these entries changed, in these words, and leaves no results. */
  void is_refused(const ScratchFolder            &folder,
                  const std::string              &scene,
                  const std::vector<std::string> &changes,
                  const std::string              &words,
                  const std::vector<std::string> &commands = {"check", "run"});

  /** Of a run, which must end well. @param word_columns of its series */
  Results results_of(const ScratchFolder            &folder,
                     const std::string              &scene,
                     const std::vector<std::string> &changes      = {},
                     const std::vector<std::string> &word_columns = {});
} // namespace apps_tests
