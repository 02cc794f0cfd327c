#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace statistics
{
  /** A linear model fitted to the runs of a table, and what each run says of it (doc/theory/studies.md, 3). */
  struct LinearFit
  {
    Eigen::VectorXd coefficients;
    Eigen::MatrixXd unscaled_covariance; ///< (X^T X)^-1; times the variance of a run: that of the coefficients
    Eigen::VectorXd fitted, residuals;
    Eigen::VectorXd leverage; ///< diagonal of the hat matrix
    Eigen::VectorXd
      left_out; ///< what the model of all other runs predicts for a run; NaN where a run alone decides a coefficient
    Eigen::VectorXd
      studentised; ///< residuals over their standard error from all other runs; NaN as above, or without a degree left
    double error_sum = 0, total_sum = 0; ///< of squares: residuals, deviations from the mean
    double press         = 0;            ///< sum of squares of what leave-one-out misses
    int    error_degrees = 0;

    double standard_error() const;     ///< of a run; NaN without a degree left
    double r_squared() const;          ///< NaN for a response that does not vary
    double adjusted_r_squared() const; ///< NaN as above
    double press_r_squared() const;    ///< 1 - press / total_sum
  };

  /**
   * Least squares by Householder QR with column pivoting, of columns scaled to one length.
   * @param matrix a row for each run, a column for each term; one of them, or a sum of some, is the mean @param terms their names
   * @throws base::InputError for fewer runs than terms, or terms that the runs do not distinguish, by name
   */
  LinearFit fit(const Eigen::MatrixXd &matrix, const Eigen::VectorXd &response, const std::vector<std::string> &terms);
} // namespace statistics
