#include "coupling/volume/turning.h"

#include <Eigen/LU>

namespace coupling
{
  using Eigen::Matrix3d;

  Turn turn_of(const Matrix3d &deformation_gradient)
  {
    // Newton's iteration for the polar factor (N. J. Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160), quadratic: four steps from a tenth.
    constexpr int    most     = 100;
    constexpr double rounding = 1e-15;
    Matrix3d         rotation = deformation_gradient;
    for (int n = 0; n < most; ++n)
      {
        const Matrix3d next = 0.5 * (rotation + rotation.inverse().transpose());
        const bool     done = (next - rotation).squaredNorm() <= rounding * rounding;
        rotation            = next;
        if (done)
          break;
      }
    const Matrix3d stretch = rotation.transpose() * deformation_gradient;
    return {rotation, rotation * (stretch.trace() * Matrix3d::Identity() - stretch).inverse() * rotation.transpose()};
  }

  Eigen::Vector3d rotation_between(const Matrix3d &before, const Matrix3d &now)
  {
    const Eigen::AngleAxisd turned(Matrix3d(now * before.transpose()));
    return turned.angle() * turned.axis();
  }
} // namespace coupling
