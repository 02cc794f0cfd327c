#pragma once

#include "tests/apps/program.h"
#include "tests/apps/scratch_folder.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace apps_tests
{
  /** A run that is stopped in its middle. */
  struct InterruptedRun
  {
    std::vector<std::string> arguments; ///< "run", the scene and changes; without the output folder
    std::vector<std::string> awaited;   ///< files below "running" in the output folder, after which it is stopped

    /** What must be equal to the last bit in two output folders. */
    std::function<std::string(const std::filesystem::path &)> reproducible_part;

    bool checkpoints_by_time = true; ///< its scene has the entry Output/Checkpoint interval
  };

  /** Starts it with the output folder "results", and sends the signal as soon as what is awaited is there. */
  Outcome interrupted_run(const ScratchFolder &folder, const InterruptedRun &what, int signal);

  /**
   * Runs it to its end into "whole"; then, once per signal, stops it (SIGKILL: with no chance to say a word), lets it go on in the way
   * that it offers, and compares. The last results are left in "results".
   */
  void
  goes_on_to_the_same_bits(const ScratchFolder &folder, const InterruptedRun &what, const std::vector<int> &signals);
} // namespace apps_tests
