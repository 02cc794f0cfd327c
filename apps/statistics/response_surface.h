#pragma once

#include "apps/statistics/factor.h"
#include "apps/statistics/least_squares.h"
#include "apps/statistics/polynomial.h"

#include <optional>
#include <vector>

namespace statistics
{
  /** Whether a surface misses more than runs at the same point differ from each other. */
  struct LackOfFit
  {
    double pure_error = 0, lack = 0; ///< sums of squares
    int    pure_degrees = 0, lack_degrees = 0;
    double f = 0, p = 0; ///< NaN where runs at the same point do not differ at all
  };

  /** A polynomial fitted to runs (doc/theory/studies.md, 4). */
  struct ResponseSurface
  {
    Polynomial      polynomial;
    Box             box;          ///< of the runs
    Eigen::VectorXd coefficients; ///< of physical variables
    Eigen::VectorXd standard_errors;
    Eigen::VectorXd coded, coded_standard_errors; ///< the same of coded variables
    LinearFit       fit;                          ///< in coded variables

    std::optional<LackOfFit> lack_of_fit; ///< where points are repeated and degrees are left

    double          value(const Eigen::VectorXd &point) const { return polynomial.at(point).dot(coefficients); }
    Eigen::VectorXd gradient(const Eigen::VectorXd &point) const
    {
      return polynomial.derivatives(point).transpose() * coefficients;
    }
  };

  enum class Degree
  {
    linear,
    quadratic
  };

  /**
   * Fit a surface in coded variables and transform it back.
   * @param copies runs (from 0) that only repeat the numbers of another one, which is no measure of scatter
   * @throws base::InputError for a factor that does not vary, fewer runs than terms, terms that the runs do not distinguish
   */
  ResponseSurface fit_surface(const std::vector<Factor> &factors,
                              const Eigen::VectorXd     &response,
                              Degree                     degree,
                              const std::vector<int>    &copies = {});
} // namespace statistics
