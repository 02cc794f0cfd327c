#pragma once

namespace statistics
{
  /**
   * Probability that a ratio of variances of these degrees of freedom exceeds `ratio`.
   * @return NaN for a ratio that is not a number or degrees below one
   */
  double f_probability_above(double ratio, double numerator_degrees, double denominator_degrees);

  /** The ratio that is exceeded with that probability. @throws std::invalid_argument outside (0, 1), or for degrees below one */
  double f_limit(double probability_above, double numerator_degrees, double denominator_degrees);

  /** Probability that |t| is exceeded, on both sides. @return NaN as above */
  double t_probability_beyond(double t, double degrees);

  /** The t that is exceeded with that probability, on one side. @throws std::invalid_argument as above */
  double t_limit(double probability_above, double degrees);

  /** The size that a normal number of variance one stays below with that probability. @throws std::invalid_argument outside (0, 1) */
  double half_normal_quantile(double probability);
} // namespace statistics
