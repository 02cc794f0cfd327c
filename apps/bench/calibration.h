#pragma once

#include <filesystem>

namespace apps
{
  struct CalibrationBench
  {
    std::filesystem::path folder;
  };

  /**
   * How often a model is run until constants are within one percent of their ranges of the truth: by plain finite differences, with updates
   * of derivatives, after a cheap model, without derivatives, and by an emulator, on the problems of calibration_problems.h.
   *
   * Also how often bands of 95 % hold the truth, of 200 calibrations each (optimisation::coverage_of()).
   *
   * Written to calibration.csv, .md and .png, and calibration_coverage.csv and .md.
   *
   * @return exit status. @throws postprocess::OutputError.
   */
  int run_calibration_bench(const CalibrationBench &bench);
} // namespace apps
