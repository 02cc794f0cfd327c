#pragma once

#include <Eigen/Core>

namespace dem
{
  /** Eigenvalues, ascending, and the eigenvectors in that order, as columns. */
  struct SymmetricModes
  {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
  };

  /**
   * Of a real symmetric matrix, of which the lower triangle is read. For small ones of a size that is known only at run time: Eigen's
   * solver, compiled once, because that takes as long as ten other sources.
   */
  SymmetricModes symmetric_modes(const Eigen::MatrixXd &matrix);
} // namespace dem
