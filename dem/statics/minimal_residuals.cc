#include "dem/statics/minimal_residuals.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  ResidualLeft MinimalResiduals::solve(const BlockMatrix      &matrix,
                                       const IncompleteFactor &factor,
                                       const Eigen::VectorXd  &b,
                                       const double            tolerance,
                                       const int               most,
                                       Eigen::VectorXd        &x)
  {
    const double size = b.norm();
    x                 = Eigen::VectorXd::Zero(b.size());
    if (size == 0)
      return {0, 0};
    basis.resize(b.size(), restart + 1);
    upper.resize(restart + 1, restart);
    left.resize(restart + 1);
    cosine.resize(restart);
    sine.resize(restart);
    z.resize(b.size());
    w = b;
    ResidualLeft report;
    while (report.residual > tolerance && report.iterations < most)
      {
        basis.col(0) = w / (report.residual * size);
        left[0]      = report.residual * size;
        const int n  = run(matrix, factor, tolerance * size, std::min(restart, most - report.iterations));
        report.iterations += n;
        upper.topLeftCorner(n, n).triangularView<Eigen::Upper>().solveInPlace(left.head(n));
        w.noalias() = basis.leftCols(n) * left.head(n);
        factor.apply(w, z);
        x += z;
        matrix.multiply(x, w);
        w                   = b - w;
        const double before = report.residual;
        report.residual     = w.norm() / size;
        if (!(report.residual < before)) // stagnates, or is not a number
          return report;
      }
    return report;
  }

  int MinimalResiduals::run(const BlockMatrix      &matrix,
                            const IncompleteFactor &factor,
                            const double            target,
                            const int               most)
  {
    for (int k = 0; k < most; ++k)
      {
        w = basis.col(k);
        factor.apply(w, z);
        matrix.multiply(z, w);
        orthogonalise(k);
        rotate(k);
        if (!(std::fabs(left[k + 1]) > target))
          return k + 1;
      }
    return most;
  }

  void MinimalResiduals::orthogonalise(const int k)
  {
    // Gram-Schmidt, repeated where much was taken away: "twice is enough" (Giraud et al. 2005).
    const auto   space  = basis.leftCols(k + 1);
    const double before = w.norm();
    auto         h      = upper.col(k).head(k + 1);
    h.noalias()         = space.transpose() * w;
    w.noalias() -= space * h;
    double norm = w.norm();
    if (norm < 0.7 * before)
      {
        const Eigen::VectorXd again = space.transpose() * w;
        w.noalias() -= space * again;
        h += again;
        norm = w.norm();
      }
    upper(k + 1, k)  = norm;
    basis.col(k + 1) = norm > 0 ? Eigen::VectorXd(w / norm) : Eigen::VectorXd(Eigen::VectorXd::Zero(w.size()));
  }

  void MinimalResiduals::rotate(const int k)
  {
    for (int i = 0; i < k; ++i)
      {
        const double a = upper(i, k), b = upper(i + 1, k);
        upper(i, k)     = cosine[i] * a + sine[i] * b;
        upper(i + 1, k) = cosine[i] * b - sine[i] * a;
      }
    const double length = std::hypot(upper(k, k), upper(k + 1, k));
    cosine[k]           = length > 0 ? upper(k, k) / length : 1;
    sine[k]             = length > 0 ? upper(k + 1, k) / length : 0;
    upper(k, k)         = length;
    left[k + 1]         = -sine[k] * left[k];
    left[k] *= cosine[k];
  }
} // namespace dem
