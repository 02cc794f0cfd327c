#pragma once

#include "dem/linear/incomplete_factor.h"
#include "dem/linear/projected_residual.h"

#include <array>

namespace dem
{
  /** How far it went. */
  struct ResidualLeft
  {
    double residual   = 1; ///< |b - A x| / |b|, true and not of the recurrence; the largest of several
    int    iterations = 0; ///< of the one that took most
  };

  /**
   * GMRES (Saad and Schultz 1986), restarted, for matrices of any kind, preconditioned from the right by a factor in single precision:
   * what that answers is kept, as it rounds anew each time (flexible, Saad 1993). Of several right sides each has a space of its own; they
   * go together, so that matrix and factor are read once for all. Keeps its memory from one solution to the next. By one
   * thread: the same bits for any number of them.
   *
   * @tparam n right sides
   */
  template <int n>
  class MinimalResiduals
  {
  public:
    /** @param tolerance of the residual @param most iterations in all @param x in: where to start, or empty; out: the solution */
    ResidualLeft solve(const BlockMatrix       &matrix,
                       IncompleteFactor<float> &factor,
                       const Columns<n>        &b,
                       double                   tolerance,
                       int                      most,
                       Columns<n>              &x);

  private:
    static constexpr int restart = 80;

    /** What one right side has found since the last restart. */
    struct Space
    {
      Eigen::MatrixXd   basis; ///< orthonormal columns
      Eigen::MatrixXf   found; ///< what the factor made of them
      ProjectedResidual projected;
      int               used = 0;
      bool              done = true;

      void begin(const Eigen::VectorXd &residual, double size);
      void orthogonalise(int k, Eigen::Ref<Eigen::VectorXd> w);
    };

    /** @return iterations */
    int  run(const BlockMatrix &matrix, IncompleteFactor<float> &factor, double tolerance, int most);
    void add_to(Columns<n> &x);

    std::array<Space, n>        spaces;
    Columns<n>                  z, w;
    Eigen::Matrix<double, n, 1> size; ///< of the right sides
  };
} // namespace dem
