#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace optimisation
{
  /** A model, data and what its constants are certified to be. */
  struct ReferenceProblem
  {
    using Constants = std::vector<double>;

    std::string            name;
    Constants              x, y;
    std::vector<Constants> starts;
    Constants              certified, standard_errors; ///< at the least sum of squares
    double                 sum_of_squares;
    double (*model)(const Eigen::VectorXd &b, double x);
  };

  /**
   * Non-linear problems of the Statistical Reference Datasets (National Institute of Standards and Technology): data, starts and certified
   * constants with standard errors, to eleven digits.
   */
  extern const std::vector<ReferenceProblem> nist_problems;
} // namespace optimisation
