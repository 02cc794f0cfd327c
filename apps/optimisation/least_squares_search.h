#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace optimisation
{
  /** Residuals at several places, which may be computed at the same time; nothing where there is no answer. */
  using Residuals =
    std::function<std::vector<std::optional<Eigen::VectorXd>>(const std::vector<Eigen::VectorXd> &places)>;

  struct LeastSquaresProblem
  {
    Eigen::VectorXd start;
    Eigen::VectorXd lower, upper; ///< of each variable; infinite: none
    Eigen::VectorXd steps;        ///< of the differences that stand for derivatives
    Residuals       residuals;
    Eigen::MatrixXd first_jacobian =
      {}; ///< of a cheaper model, to begin with where Jacobians are updated; empty: by differences
  };

  struct LeastSquaresOptions
  {
    bool   central_differences = false; ///< twice the evaluations, for smooth models
    bool   updated_jacobian    = false; ///< Broyden's updates between differences, for costly models
    bool   jacobian_at_end     = true;  ///< of the fit, by differences
    int    most_evaluations    = 1000;
    double smallest_decrease   = 1e-12; ///< of the sum of squares in one step, over the sum; then it ends
    double smallest_sum        = 0;     ///< of squares; then it ends
    double smallest_step       = 0; ///< over the steps of the differences: then it ends, as what is shorter shows noise
  };

  struct LeastSquaresFit
  {
    Eigen::VectorXd place, residuals;
    Eigen::MatrixXd jacobian; ///< of the residuals, by differences at the place; empty where it was not requested
    int             evaluations = 0, failed = 0;
    bool            converged = false;
    std::string     ending; ///< why it ended, a sentence

    double sum_of_squares() const { return residuals.squaredNorm(); }
  };

  /**
   * Bounded non-linear least squares: Levenberg and Marquardt's method of Ceres with differences for derivatives, which stay within the
   * bounds (doc/theory/studies.md, 7). A place without an answer is left for a shorter step.
   *
   * @throws base::InputError when the start has no answer or is not within the bounds, or when there are fewer residuals than variables
   */
  LeastSquaresFit least_squares(const LeastSquaresProblem &problem, const LeastSquaresOptions &options);
} // namespace optimisation
