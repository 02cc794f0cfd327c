#pragma once

#include "dem/statics/incomplete_factor.h"

namespace dem
{
  /** How far it went. */
  struct ResidualLeft
  {
    double residual   = 1; ///< |b - A x| / |b|, true and not of the recurrence
    int    iterations = 0;
  };

  /**
   * GMRES (Saad and Schultz 1986), restarted, preconditioned from the right, for matrices of any kind; keeps its memory from one
   * solution to the next. By one thread: the same bits for any number of them.
   */
  class MinimalResiduals
  {
  public:
    /** @param tolerance of the residual @param most iterations in all @param x out: the solution, started from zero */
    ResidualLeft solve(const BlockMatrix      &matrix,
                       const IncompleteFactor &factor,
                       const Eigen::VectorXd  &b,
                       double                  tolerance,
                       int                     most,
                       Eigen::VectorXd        &x);

  private:
    static constexpr int restart = 80;

    int  run(const BlockMatrix &matrix, const IncompleteFactor &factor, double target, int most);
    void orthogonalise(int k);
    void rotate(int k);

    Eigen::MatrixXd basis;        ///< columns of the Krylov space
    Eigen::MatrixXd upper;        ///< triangular: of the space's projection
    Eigen::VectorXd left, z, w;   ///< of the projected residual; work space
    Eigen::VectorXd cosine, sine; ///< rotations
  };
} // namespace dem
