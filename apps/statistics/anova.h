#pragma once

#include "apps/statistics/factor.h"
#include "apps/statistics/least_squares.h"

#include <string>
#include <vector>

namespace statistics
{
  /** What one factor explains of the scatter of a response. */
  struct Effect
  {
    std::string factor;
    double      sum_of_squares = 0;
    int         degrees        = 0;
    double      f = 0, p = 0; ///< NaN where there is no error to compare with
  };

  /** Analysis of variance of main effects (doc/theory/studies.md, 2). */
  struct Anova
  {
    std::vector<Effect> effects;
    double              error_sum = 0, total_sum = 0;
    int                 error_degrees = 0;
    LinearFit           fit; ///< of all effects
  };

  /**
   * Sums of squares of type III: what the residuals grow by when a factor is left out of the model. In proportional designs these are
   * the deviations of the level means.
   *
   * @param null_as_error name of a column without a factor, whose sum of squares is then taken as the error; "": residuals are
   * @throws base::InputError when the runs do not distinguish factors, or there is no such column
   */
  Anova analyse_variance(const std::vector<Factor> &factors,
                         const Eigen::VectorXd     &response,
                         const std::string         &null_as_error = "");
} // namespace statistics
