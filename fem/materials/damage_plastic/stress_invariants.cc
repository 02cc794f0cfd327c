#include "fem/materials/damage_plastic/stress_invariants.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace fem
{
  namespace
  {
    const double pi = std::acos(-1.0);

    Eigen::Vector3d angles(const double theta) { return {theta, theta - 2 * pi / 3, theta + 2 * pi / 3}; }
  }

  StressInvariants::StressInvariants(const base::Voigt &stress)
    : volumetric(base::trace(stress) / 3)
  {
    const base::Voigt deviator = stress - volumetric * base::voigt_identity();
    deviatoric                 = std::sqrt(deviator.head<3>().squaredNorm() + 2 * deviator.tail<3>().squaredNorm());
    if (!(deviatoric > 0))
      {
        lode = pi / 6;
        direction.setZero();
        lode_direction.setZero();
        return;
      }
    direction = deviator / deviatoric;

    // From principal values: the angle stays accurate at the meridians, where acos of the invariants loses half its digits.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(base::stress_tensor(direction));
    const Eigen::Vector3d                                m = eigen.eigenvalues().reverse();
    lode = std::atan2(std::sqrt(3.0) * (m[1] - m[2]), 2 * m[0] - m[1] - m[2]);

    const Eigen::Vector3d t = principal_lode_direction();
    const Eigen::Matrix3d v = eigen.eigenvectors().rowwise().reverse();
    lode_direction          = base::stress_voigt(v * t.asDiagonal() * v.transpose());
  }

  Eigen::Vector3d StressInvariants::principal_direction() const
  {
    return std::sqrt(2.0 / 3.0) * angles(lode).array().cos();
  }

  Eigen::Vector3d StressInvariants::principal_lode_direction() const
  {
    return -std::sqrt(2.0 / 3.0) * angles(lode).array().sin();
  }
}
