#include "dem/linear/projected_residual.h"

#include <cmath>

namespace dem
{
  void ProjectedResidual::begin(const int most, const double norm)
  {
    upper.resize(most + 1, most);
    left.resize(most + 1);
    cosine.resize(most);
    sine.resize(most);
    left[0] = norm;
  }

  double ProjectedResidual::take(const int k)
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
    return std::fabs(left[k + 1]);
  }

  Eigen::VectorXd ProjectedResidual::weights(const int k) const
  {
    Eigen::VectorXd solution = left.head(k);
    upper.topLeftCorner(k, k).triangularView<Eigen::Upper>().solveInPlace(solution);
    return solution;
  }
} // namespace dem
