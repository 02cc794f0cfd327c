#pragma once

#include "dem/network/elastic_network.h"
#include "dem/network/stiffness_operator.h"

#include <Eigen/Core>

#include <utility>

namespace dem
{
  /** Slip and relative rotation of a link's ends per motion of one of them, rotations as lengths. */
  using SlipOf = Eigen::Matrix<double, 6, motions>;

  /** v x as a matrix. */
  inline Eigen::Matrix3d cross_product_matrix(const Eigen::Vector3d &v)
  {
    Eigen::Matrix3d m;
    m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return m;
  }

  /** Of the first and of the second end (doc/theory/statics.md, 1). @param scale that makes lengths of rotations [m] */
  inline std::pair<SlipOf, SlipOf> slip_matrices(const ElasticLink &l, const double scale)
  {
    const Eigen::Matrix3d turn = cross_product_matrix(l.direction) / scale;
    const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity(), none = Eigen::Matrix3d::Zero();
    SlipOf                J, K;
    J << -unit, l.arm_first * turn, none, -unit / scale;
    K << unit, l.arm_second * turn, none, unit / scale;
    return {J, K};
  }
} // namespace dem
