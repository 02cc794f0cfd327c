#pragma once

#include <Eigen/Core>

namespace statistics
{
  /** Distance of axial points at which the variance of prediction depends on the distance from the centre alone: 2^(factors / 4). */
  double rotatable_distance(int factors);

  /**
   * Central composite design in coded variables: 2^p corners at +-1, 2 p axial points at +-distance, centres; in this order.
   * @throws base::InputError unless there are 2 to 10 factors, a positive distance and no negative number of centres
   */
  Eigen::MatrixXd central_composite(int factors, double axial_distance, int centres);

  /**
   * Box and Behnken's design in coded variables: blocks of factors at all combinations of +-1 while the others stay at zero, then
   * the centres. Blocks are all pairs for 3 to 5 factors, the triples of the paper for 6 and 7.
   * @throws base::InputError for other numbers of factors
   */
  Eigen::MatrixXd box_behnken(int factors, int centres);
} // namespace statistics
