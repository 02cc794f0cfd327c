#pragma once

#include "apps/optimisation/least_squares_search.h"
#include "apps/statistics/uncertainty.h"
#include "apps/studies/calibration_runs.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace apps
{
  /** Constants that make runs give what was measured, and how sure they are. */
  struct Calibration
  {
    Eigen::VectorXd   constants, standard_errors; ///< errors: NaN where there are none
    Eigen::VectorXd   lower, upper;               ///< of the bands of 95 %, within the bounds; NaN likewise
    std::vector<bool> determined;
    Eigen::MatrixXd   correlation;
    double            condition = 0;
    Eigen::VectorXd   predicted, half_widths; ///< for what was measured; bands of 95 %
    double            relative_sum = 0;       ///< sum of squared deviations over squared targets, in their scales
    int               evaluations = 0, failed = 0;
    std::string       ending;

    std::vector<std::string> warnings; ///< sentences
  };

  /**
   * Bounded least squares over runs; constants that the data do not determine go back to their start and are held, and the others are
   * sought again (doc/theory/studies.md, 9). @throws base::InputError, CalibrationInterrupted
   */
  Calibration calibrate(const CalibrationFile &file, CalibrationRuns &runs);

  /** What calibration.json holds (doc/formats.md). */
  nlohmann::json json_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found);
  /** What a terminal shows. */
  std::string words_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found);
  /** TARGET.csv of a curve: measured, predicted, half width of its band. */
  std::string
  curve_csv_of(const CalibrationFile &file, const CalibrationRuns &runs, const Calibration &found, std::size_t target);
} // namespace apps
