#pragma once

#include "base/matrix6.h"

#include <cmath>

namespace base
{
  /**
   * A symmetric tensor as six numbers, order 11, 22, 33, 23, 31, 12, shears times sqrt 2 (Mandel, 1965).
   *
   * The double contraction of two tensors is then the dot product of their columns, a rotation an orthogonal 6 x 6 matrix and a
   * fourth-order tensor with minor symmetries a plain 6 x 6 matrix.
   */
  inline Vector6 to_mandel(const Eigen::Matrix3d &t)
  {
    const double s = std::sqrt(0.5); // sqrt 2 times the mean of the two entries
    Vector6      m;
    m << t(0, 0), t(1, 1), t(2, 2), s * (t(1, 2) + t(2, 1)), s * (t(2, 0) + t(0, 2)), s * (t(0, 1) + t(1, 0));
    return m;
  }

  inline Eigen::Matrix3d from_mandel(const Vector6 &m)
  {
    const double    s = std::sqrt(0.5);
    Eigen::Matrix3d t;
    t << m[0], s * m[5], s * m[4], s * m[5], m[1], s * m[3], s * m[4], s * m[3], m[2];
    return t;
  }
} // namespace base
