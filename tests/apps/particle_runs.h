#pragma once

#include "postprocess/csv_table.h"
#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace apps_tests
{
  /** What a run of a scene of kind "particles" left behind. */
  struct Results
  {
    nlohmann::json        summary;
    postprocess::CsvTable series;

    double figure(const char *gauge, const char *when) const;
    double balance_error() const;
  };

  /** `breccia <command> <scene>` with these entries changed; a run leaves the folder "results". */
  Outcome outcome_of(const ScratchFolder            &folder,
                     const std::string              &command,
                     const std::string              &scene,
                     const std::vector<std::string> &changes);

  /** Of a run, which must end well. */
  Results
  results_of(const ScratchFolder &folder, const std::string &scene, const std::vector<std::string> &changes = {});

  /** Head of a scene of balls of 2500 kg/m^3 that are not bonded, whose contacts have this modulus [Pa]. */
  std::string loose_balls(const std::string &effective_modulus);
} // namespace apps_tests
