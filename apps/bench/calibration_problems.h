#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace apps
{
  /** Constants of a cheap model that are sought again: what stands for a costly one. */
  struct CalibrationProblem
  {
    std::string     name, meaning;
    Eigen::VectorXd truth, start, lower, upper;

    std::function<Eigen::VectorXd(const Eigen::VectorXd &)> model, cheap; ///< outputs; cheap: biased by a tenth
  };

  /** Curves of stress over strain with three and six constants, one of them rippled as the breaking of links makes it, and a modulus with two strengths. */
  std::vector<CalibrationProblem> calibration_problems();
} // namespace apps
