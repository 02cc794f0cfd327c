#pragma once

#include "apps/scene/section.h"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** A constant that is sought: one or several entries of the scenes that are given the same value. */
  struct SoughtConstant
  {
    std::string name, entries;
    double      start = 0, lower = 0, upper = 0;
  };

  /** What a run shall give: a figure, or a curve of its series. */
  struct CalibrationTarget
  {
    std::string name, scene, figure;
    double      value = 0;
    std::string curve, abscissa = "strain", ordinate = "stress", test;
    double      deviation = 0; ///< standard deviation of what was measured; 0: not known
    double      weight    = 1;

    bool is_curve() const { return figure.empty(); }
  };

  /** A calibration as its file says it (doc/tutorials/calibrate.md). */
  struct CalibrationFile
  {
    std::string                   file; ///< as typed
    std::string                   kind, base_scene, output_folder;
    std::int64_t                  threads_per_run = 1, most_runs = 200;
    double                        step = 0.03, smallest_relative_sum = 0, smallest_decrease = 0.01;
    bool                          central_differences = false, updated_jacobian = true;
    std::string                   seed_entry, seeds_text;
    std::deque<SoughtConstant>    constants;
    std::deque<CalibrationTarget> targets;
    std::unique_ptr<Section>      root;
  };

  /** @throws base::InputError naming file, line and entry */
  std::unique_ptr<CalibrationFile> read_calibration(const std::string &file, const std::vector<std::string> &overrides);
} // namespace apps
