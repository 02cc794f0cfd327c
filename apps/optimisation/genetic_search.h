#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>

namespace optimisation
{
  struct GeneticOptions
  {
    int           population  = 300; ///< even
    int           generations = 300;
    std::uint64_t seed        = 1;
  };

  /**
   * The least value of a function in the unit cube: pagmo's genetic algorithm (simulated binary crossover, Gaussian mutation whose
   * width falls, tournaments of two, the best of parents and children survive), then a compass search from the best place. The same seed gives
   * the same answer.
   *
   * @throws base::InputError for less than one variable, or a population that is odd or below 4
   */
  Eigen::VectorXd genetic_minimum(const std::function<double(const Eigen::VectorXd &)> &function,
                                  int                                                   variables,
                                  const GeneticOptions                                 &options);
} // namespace optimisation
