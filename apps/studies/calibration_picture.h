#pragma once

#include "apps/studies/calibration.h"

namespace apps
{
  /**
   * Draw how far figures are off what was measured, at the start and with the constants found, and where between their bounds these lie,
   * with their bands of 95 %. @return why not, for a warning; empty when drawn
   */
  [[nodiscard]] std::string draw_figures_and_constants(const CalibrationFile       &file,
                                                       const CalibrationRuns       &runs,
                                                       const Calibration           &found,
                                                       const std::filesystem::path &path);
} // namespace apps
