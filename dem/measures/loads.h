#pragma once

#include <Eigen/Core>

namespace dem
{
  /**
   * A link as the bearer of a force: the input of stress measures, from dynamics, the static solver or a test.
   *
   * Force and couple are those that act on the first end; the second end feels their opposites. A tensile force points along the
   * branch.
   */
  struct LinkLoad
  {
    Eigen::Vector3d first   = {0, 0, 0}; ///< x_J, place of the first end [m]
    Eigen::Vector3d branch  = {0, 0, 0}; ///< l, from the first end to the second, its periodic image if need be [m]
    Eigen::Vector3d contact = {0, 0, 0}; ///< c, where the force acts [m]
    Eigen::Vector3d force   = {0, 0, 0}; ///< f on the first end [N]
    Eigen::Vector3d couple  = {0, 0, 0}; ///< on the first end at the contact point, beyond that of f [N m]

    Eigen::Vector3d second() const { return first + branch; }
  };

  /** A force and a couple from outside on a particle. */
  struct ExternalLoad
  {
    Eigen::Vector3d place  = {0, 0, 0}; ///< [m]
    Eigen::Vector3d force  = {0, 0, 0}; ///< [N]
    Eigen::Vector3d couple = {0, 0, 0}; ///< [N m]
  };
} // namespace dem
