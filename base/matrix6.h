#pragma once

#include <Eigen/Core>

namespace base
{
  /** Six numbers, such as a symmetric tensor or a motion of a body, and what maps them. */
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
} // namespace base
