#pragma once

#include "dem/kernels/kinematics.h"

#include <Eigen/Core>

namespace dem
{
  /** Enter a rotation in a particle's pose as its step does: by twice the tangent of half its angle (doc/theory/shear-kinematics.md). */
  inline void set_arm_turn(double *pose, const double *motion)
  {
    const Eigen::Vector3d turn(motion + 3);
    const double          angle     = turn.squaredNorm();
    const Eigen::Vector3d stretched = half_tangent_factor(rotation_coefficients(angle), angle) * turn;
    for (int c = 0; c < 3; ++c)
      pose[3 + c] = stretched[c];
  }
} // namespace dem
