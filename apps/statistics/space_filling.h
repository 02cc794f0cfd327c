#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace statistics
{
  /**
   * Latin hypercube in the unit cube: of as many slices of each factor as there are runs, each holds one run, at a random place in it.
   * The same seed gives the same bits everywhere. @throws base::InputError for less than one run or factor
   */
  Eigen::MatrixXd latin_hypercube(int runs, int factors, std::uint64_t seed);

  /** The first points of Sobol's sequence in the unit cube, without the origin. @throws base::InputError as above, or above 3667 factors */
  Eigen::MatrixXd sobol_points(int runs, int factors);
} // namespace statistics
