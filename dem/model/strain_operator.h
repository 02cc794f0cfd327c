#pragma once

#include <Eigen/Core>

namespace dem
{
  /**
   * H of a link: H E is the displacement of its second end relative to the first under the strain E, engineering shears, order
   * 11 22 33 23 31 12 (doc/theory/statics.md, 1).
   * @param branch from the first end to the second [m]
   */
  inline Eigen::Matrix<double, 3, 6> strain_operator(const Eigen::Vector3d &branch)
  {
    const Eigen::Vector3d      &l = branch;
    Eigen::Matrix<double, 3, 6> h;
    h << l[0], 0, 0, 0, l[2] / 2, l[1] / 2, //
      0, l[1], 0, l[2] / 2, 0, l[0] / 2,    //
      0, 0, l[2], l[1] / 2, l[0] / 2, 0;
    return h;
  }
} // namespace dem
