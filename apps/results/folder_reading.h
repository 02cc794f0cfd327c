#pragma once

#include "apps/results/run_result.h"

#include <filesystem>

namespace apps
{
  /** Whether a folder has the scene and summary of a complete run. */
  bool holds_a_run(const std::filesystem::path &folder);

  /**
   * What a run left in its folder: summary, series (where it has one) and place.
   * @throws base::InputError for a folder without a complete run, and for files in it that cannot be read
   */
  RunResult read_result(const std::filesystem::path &folder);
} // namespace apps
