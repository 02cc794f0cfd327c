#pragma once

#include <Eigen/Core>

#include <vector>

namespace statistics
{
  /** How sure constants are that were fitted by least squares (doc/theory/studies.md, 8). */
  struct Uncertainty
  {
    Eigen::VectorXd  standard_errors;     ///< NaN of those that are not determined
    Eigen::MatrixXd  covariance;          ///< zero of those that are not determined
    Eigen::MatrixXd  covariance_of_noise; ///< the part of it that is due to the noise of the model; empty: none
    Eigen::MatrixXd  correlation;         ///< likewise, but one on the diagonal
    std::vector<int> undetermined;        ///< from 0, in the order in which they were taken out
    double           condition     = 0;   ///< of J^T J in units of `ranges`, of those that are determined
    double           scatter       = 0;   ///< standard deviation of a residual
    int              degrees       = 0;   ///< residuals less determined constants
    double           draws         = 0;   ///< of the noise of the model, independent ones
    bool             known_scatter = false;

    /** Half width of the band that holds a constant with that probability; NaN where it is not determined. */
    double half_width(int constant, double probability) const;
    /** The same of a prediction with these derivatives by the constants, without the scatter of a single observation. */
    double half_width_of(const Eigen::VectorXd &derivatives, double probability) const;

  private:
    /** In the direction of these derivatives. */
    double quantile(const Eigen::VectorXd &derivatives, double probability) const;
  };

  struct UncertaintyOptions
  {
    std::vector<int> held;                    ///< constants that were not fitted, or lie on a bound: not determined
    double           known_scatter     = 0;   ///< standard deviation of a residual; 0: from the residuals
    double           largest_condition = 1e8; ///< beyond it the least determined constant is taken out
    double noise_degrees  = 0; ///< independent draws that those of the noise are worth; 0: as many as there are
    double jacobian_noise = 0; ///< expected squared norm of the noise in a column of the Jacobian, in units of `ranges`
    double noise_share    = 1; ///< of the variance of one answer's noise in what the constants were found from
    Eigen::MatrixXd model_noise = {}; ///< a column each: draws of what residuals are off a smooth model by; empty: none
  };

  /**
   * @param jacobian of the residuals by the constants, at the least sum of squares @param ranges of the constants, as units
   * @throws base::InputError for fewer residuals than constants, or as many without a known scatter
   */
  Uncertainty uncertainty(const Eigen::MatrixXd    &jacobian,
                          const Eigen::VectorXd    &residuals,
                          const Eigen::VectorXd    &ranges,
                          const UncertaintyOptions &options = {});
} // namespace statistics
