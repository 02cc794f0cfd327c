#include "dem/core/symmetric_modes.h"

#include <Eigen/Eigenvalues>

namespace dem
{
  SymmetricModes symmetric_modes(const Eigen::MatrixXd &matrix)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(matrix);
    return {modes.eigenvalues(), modes.eigenvectors()};
  }
} // namespace dem
