#pragma once

#include "dem/observation/specimen_damage.h"

#include <vector>

namespace dem
{
  class ObservedSpecimen;

  /**
   * What a continuum needs to know of a specimen to carry on from it: places, shares of volume and stress of the particles, and the
   * damage of all cohesive links that they were made with. Made by this program or another.
   */
  struct DiscreteState
  {
    int    dimension = 3;
    double time      = 0; ///< [s]

    std::vector<Eigen::Vector3d> reference; ///< places when the specimen was made [m]
    std::vector<Eigen::Vector3d> position;  ///< places now [m]
    std::vector<double>          radius;    ///< [m]
    std::vector<double>          volume;    ///< share of the specimen's volume, voids included [m^3]
    std::vector<Eigen::Matrix3d> stress;    ///< Love-Weber, symmetric, tension positive [Pa]
    std::vector<std::int32_t>    held;      ///< 1: prescribed by a grip, no part of the free material

    CohesiveDamage damage;

    std::size_t size() const { return radius.size(); }
  };

  DiscreteState discrete_state(const ObservedSpecimen &specimen);

  /**
   * @param origin where it came from, for the message.
   * @throws base::InputError naming the first column of wrong length, or the first particle or link with a value that cannot be.
   */
  void check_discrete_state(const DiscreteState &state, const std::string &origin);
} // namespace dem
