#include "dem/linear/minimal_residuals.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  template <int n>
  ResidualLeft MinimalResiduals<n>::solve(const BlockMatrix       &matrix,
                                          IncompleteFactor<float> &factor,
                                          const Columns<n>        &b,
                                          const double             tolerance,
                                          const int                most,
                                          Columns<n>              &x)
  {
    const auto left_of = [&](const int i) { return size[i] > 0 ? w.col(i).norm() / size[i] : 0.0; };
    size               = b.colwise().norm().transpose();
    w.resize(b.rows(), n);
    if (x.rows() == b.rows())
      matrix.multiply<n>(x, w);
    else
      {
        x = Columns<n>::Zero(b.rows(), n);
        w.setZero();
      }
    w = b - w;
    for (int i = 0; i < n; ++i)
      if (!(left_of(i) < 1)) // a start that is worse than none
        {
          x.col(i).setZero();
          w.col(i) = b.col(i);
        }
    std::array<double, n> before;
    before.fill(2);
    ResidualLeft report;
    for (;;)
      {
        report.residual = 0;
        bool stagnates  = false;
        for (int i = 0; i < n && std::isfinite(report.residual); ++i)
          {
            const double left = left_of(i);
            stagnates         = stagnates || (!(left <= tolerance) && !(left < before[i]));
            report.residual   = std::isfinite(left) ? std::max(report.residual, left) : left;
            before[i]         = left;
          }
        if (report.residual <= tolerance || report.iterations >= most || stagnates)
          return report;
        report.iterations += run(matrix, factor, tolerance, std::min(restart, most - report.iterations));
        add_to(x);
        matrix.multiply<n>(x, w);
        w = b - w;
      }
  }

  template <int n>
  void MinimalResiduals<n>::Space::begin(const Eigen::VectorXd &residual, const double norm)
  {
    basis.resize(residual.size(), restart + 1);
    found.resize(residual.size(), restart);
    projected.begin(restart, norm);
    used         = 0;
    done         = false;
    basis.col(0) = residual / norm;
  }

  template <int n>
  int MinimalResiduals<n>::run(const BlockMatrix       &matrix,
                               IncompleteFactor<float> &factor,
                               const double             tolerance,
                               const int                most)
  {
    z.resize(w.rows(), n);
    for (int i = 0; i < n; ++i)
      {
        const double norm = w.col(i).norm();
        spaces[i].used    = 0;
        spaces[i].done    = !(norm > tolerance * size[i]);
        if (!spaces[i].done)
          spaces[i].begin(w.col(i), norm);
      }
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(w.rows());
    Eigen::VectorXf       unused(w.rows());
    for (int k = 0; k < most; ++k)
      {
        std::array<const double *, n> given;
        std::array<float *, n>        made;
        bool                          all_done = true;
        for (int i = 0; i < n; ++i)
          {
            all_done = all_done && spaces[i].done;
            given[i] = spaces[i].done ? nothing.data() : spaces[i].basis.col(k).data();
            made[i]  = spaces[i].done ? unused.data() : spaces[i].found.col(k).data();
          }
        if (all_done)
          return k;
        factor.apply<n>(given, made);
        for (int i = 0; i < n; ++i)
          z.col(i) = Eigen::Map<const Eigen::VectorXf>(made[i], w.rows()).template cast<double>();
        matrix.multiply<n>(z, w);
        for (int i = 0; i < n; ++i)
          if (!spaces[i].done)
            {
              Space &of = spaces[i];
              of.orthogonalise(k, w.col(i));
              of.used = k + 1;
              of.done = !(of.projected.take(k) > tolerance * size[i]);
            }
      }
    return most;
  }

  template <int n>
  void MinimalResiduals<n>::add_to(Columns<n> &x)
  {
    for (int i = 0; i < n; ++i)
      if (const int k = spaces[i].used; k > 0)
        {
          const Space          &of     = spaces[i];
          const Eigen::VectorXd weight = of.projected.weights(k);
          for (int j = 0; j < k; ++j)
            x.col(i) += weight[j] * of.found.col(j).template cast<double>();
        }
  }

  template <int n>
  void MinimalResiduals<n>::Space::orthogonalise(const int k, Eigen::Ref<Eigen::VectorXd> w)
  {
    // Gram-Schmidt, repeated where much was taken away: "twice is enough" (Giraud et al. 2005).
    const auto   space  = basis.leftCols(k + 1);
    const double before = w.norm();
    auto         h      = projected.components(k).head(k + 1);
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
    projected.components(k)[k + 1] = norm;
    if (norm > 0)
      basis.col(k + 1) = w / norm;
    else
      basis.col(k + 1).setZero();
  }

  template class MinimalResiduals<1>;
  template class MinimalResiduals<motions>;
} // namespace dem
