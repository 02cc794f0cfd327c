#pragma once

#include "apps/studies/calibration_runs.h"

#include <string>
#include <vector>

namespace apps
{
  /** Whether a curve stops where it is farthest from zero: of the strength it then says only that it is not less. @pre not empty */
  bool ends_at_its_peak(const Eigen::VectorXd &ordinates);

  /** What makes error bars narrower than errors, by the names of the targets: sentences. */
  std::vector<std::string> doubts_of(const CalibrationFile &file, const CalibrationRuns &runs);
} // namespace apps
