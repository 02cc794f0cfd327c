#include "coupling/multiscale/stretch.h"

#include "fem/materials/response.h"

#include <Eigen/Eigenvalues>

namespace coupling
{
  using Eigen::Matrix3d;

  Stretch::Stretch(const base::Voigt &green)
  {
    const Matrix3d                                C = 2 * base::strain_tensor(green) + Matrix3d::Identity();
    const Eigen::SelfAdjointEigenSolver<Matrix3d> of_C(C);
    if (!(of_C.eigenvalues()[0] > 0))
      throw fem::MaterialFailure("the element is inverted: a stretch is not positive.");
    axes      = of_C.eigenvectors();
    stretches = of_C.eigenvalues().cwiseSqrt();
    // U U = 2 E + 1: dU U + U dU = 2 dE.
    for (int c = 0; c < 6; ++c)
      by_green.col(c) = base::strain_voigt(divided(2 * base::strain_tensor(base::Voigt::Unit(c))));
  }

  Matrix3d Stretch::divided(const Matrix3d &tensor) const
  {
    Matrix3d X = axes.transpose() * tensor * axes;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        X(i, j) /= stretches[i] + stretches[j];
    return axes * X * axes.transpose();
  }

  base::Voigt Stretch::strain() const
  {
    return base::strain_voigt(axes * (stretches.array() - 1).matrix().asDiagonal() * axes.transpose());
  }

  base::Stiffness Stretch::tangent(const base::Voigt &of_law, const base::Stiffness &tangent_of_law) const
  {
    base::Stiffness all = by_green.transpose() * tangent_of_law * by_green;
    // Once more: d2U U + U d2U = -(dU' dU + dU dU'); T : d2U = -divided(T) : (dU' dU + dU dU').
    const Matrix3d weight = divided(base::stress_tensor(of_law));
    Matrix3d       dU[6];
    for (int c = 0; c < 6; ++c)
      dU[c] = base::strain_tensor(by_green.col(c));
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        all(i, j) -= weight.cwiseProduct(dU[i] * dU[j] + dU[j] * dU[i]).sum();
    return all;
  }
} // namespace coupling
