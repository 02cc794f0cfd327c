#include "dem/homogenisation/isotropy.h"

#include "base/errors.h"
#include "dem/core/symmetric_modes.h"

#include <cmath>
#include <vector>

namespace dem
{
  namespace
  {
    double mean(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double v : values)
        sum += v;
      return sum / static_cast<double>(values.size());
    }

    double largest_distance(const std::vector<double> &values, const double from)
    {
      double distance = 0;
      for (const double v : values)
        distance = std::fmax(distance, std::fabs(v - from));
      return distance;
    }

    Eigen::MatrixXd existing_part(const MacroscopicStiffness &D, const int dimension)
    {
      if (dimension == 3)
        return D;
      const int       kept[] = {0, 1, 5};
      Eigen::Matrix3d plane;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          plane(i, j) = D(kept[i], kept[j]);
      return plane;
    }

    /** Compliance; a stiffness with a direction of hardly any resistance has none. */
    Eigen::MatrixXd compliance(const Eigen::MatrixXd &D)
    {
      const SymmetricModes eigen   = symmetric_modes(0.5 * (D + D.transpose()));
      const double         largest = eigen.values.maxCoeff();
      if (!(eigen.values.minCoeff() > 1e-12 * largest))
        throw base::NumericalError("homogenisation: the cell does not resist every strain, its moduli do not exist. "
                                   "Raise the interaction ratio, or take a denser packing.");
      return eigen.vectors * eigen.values.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
    }
  } // namespace

  IsotropyMeasures isotropy_measures(const MacroscopicStiffness &full, const int dimension)
  {
    const Eigen::MatrixXd D = existing_part(full, dimension), C = compliance(D);
    const int             axes = dimension, size = static_cast<int>(D.rows());

    std::vector<double> young, poisson, shear;
    for (int i = 0; i < axes; ++i)
      {
        young.push_back(1 / C(i, i));
        for (int j = 0; j < axes; ++j)
          if (i != j)
            poisson.push_back(-C(j, i) / C(i, i));
      }
    for (int i = axes; i < size; ++i)
      shear.push_back(1 / C(i, i));

    IsotropyMeasures m;
    m.mean            = {mean(young), mean(poisson)};
    m.shear           = mean(shear);
    m.isotropic_shear = m.mean.young / (2 * (1 + m.mean.poisson));
    m.young_spread    = largest_distance(young, m.mean.young) / m.mean.young;
    m.poisson_spread  = largest_distance(poisson, m.mean.poisson);
    m.shear_spread    = largest_distance(shear, m.isotropic_shear) / m.isotropic_shear;
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        if (i != j && (i >= axes || j >= axes))
          m.off = std::fmax(m.off, std::fabs(D(i, j)) / m.mean.young);
    m.asymmetry = (D - D.transpose()).cwiseAbs().maxCoeff() / m.mean.young;
    return m;
  }
} // namespace dem
