#pragma once

#include <Eigen/Core>

namespace dem
{
  /**
   * The least-squares problem that GMRES (Saad and Schultz 1986) leaves of one right side: the residual over an orthonormal basis, made
   * smallest by rotations as the basis grows.
   */
  class ProjectedResidual
  {
  public:
    /** @param most basis vectors to come @param norm of the residual, the first of them times it */
    void begin(int most, double norm);

    /** Of what the matrix made of the k-th direction, the k + 2 components along the basis: to be filled. */
    auto components(const int k) { return upper.col(k).head(k + 2); }

    /** Take the k-th direction in. @return norm of the residual with it */
    double take(int k);

    /** Of the first k directions, in the solution. */
    Eigen::VectorXd weights(int k) const;

  private:
    Eigen::MatrixXd upper;        ///< triangular, as far as directions are taken in
    Eigen::VectorXd left;         ///< of the residual
    Eigen::VectorXd cosine, sine; ///< of the rotations
  };
} // namespace dem
