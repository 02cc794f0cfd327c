#pragma once

#include "dem/measures/loads.h"

#include <vector>

namespace dem
{
  /**
   * Volume times mean stress of an assembly from its links, V sigma = sum l (x) f [N m] (doc/theory/stress-and-fabric.md, 1; Love, Weber).
   *
   * First index: normal of the plane, second: direction of the force; tension positive. Holds in periodic cells with branches
   * taken to the image. In equilibrium under forces on particles it equals the external form. Unsymmetric only with net couples.
   */
  Eigen::Matrix3d stress_moment(const std::vector<LinkLoad> &links);

  /** The same from the loads on the assembly's particles, V sigma = sum x (x) f [N m] (Stransky, 2018, (4.18)). @pre forces sum to zero */
  Eigen::Matrix3d stress_moment(const std::vector<ExternalLoad> &loads);

  /** Mean stress [Pa] from its moment. @param volume [m^3], voids included @throws std::invalid_argument unless volume > 0 */
  Eigen::Matrix3d stress_of(const Eigen::Matrix3d &moment, double volume);

  /** 1 x S, the vector e_ijk S_jk: twice the skew part of S as an axial vector; zero for a symmetric tensor. */
  Eigen::Vector3d axial(const Eigen::Matrix3d &tensor);
} // namespace dem
