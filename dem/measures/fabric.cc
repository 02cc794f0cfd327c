#include "dem/measures/fabric.h"

#include <stdexcept>
#include <string>

namespace dem
{
  Fabric fabric(const std::vector<Eigen::Vector3d> &directions, const std::vector<double> &weights)
  {
    if (!weights.empty() && weights.size() != directions.size())
      throw std::invalid_argument("fabric: " + std::to_string(directions.size()) + " directions but " +
                                  std::to_string(weights.size()) + " weights.");
    Fabric result;
    for (std::size_t i = 0; i < directions.size(); ++i)
      {
        const double          w       = weights.empty() ? 1.0 : weights[i];
        const Eigen::Matrix3d product = directions[i] * directions[i].transpose();
        const base::Vector6   column  = base::to_mandel(product);
        result.second += w * product;
        result.fourth += w * column * column.transpose();
        result.weight += w;
      }
    if (!(result.weight > 0))
      throw std::invalid_argument("fabric: no direction, or weights that sum to nothing.");
    result.second /= result.weight;
    result.fourth /= result.weight;
    return result;
  }

  namespace
  {
    /** Directions spread evenly in the space or plane spanned by `identity`: <nn> = second 1, <nnnn> = fourth (dd + dd + dd). */
    Fabric even_fabric(const Eigen::Matrix3d &identity, const double second, const double fourth)
    {
      Fabric              result;
      const base::Vector6 d = base::to_mandel(identity);
      result.second         = second * identity;
      result.fourth         = fourth * d * d.transpose();
      for (int i = 0; i < 6; ++i) // d_ik d_jl + d_il d_jk is twice the identity of the symmetric tensors in that space
        {
          const int a = i < 3 ? i : (i - 2) % 3, b = i < 3 ? i : (i - 1) % 3;
          result.fourth(i, i) += 2 * fourth * identity(a, a) * identity(b, b);
        }
      return result;
    }
  } // namespace

  Fabric isotropic_fabric() { return even_fabric(Eigen::Matrix3d::Identity(), 1.0 / 3.0, 1.0 / 15.0); }

  Fabric plane_isotropic_fabric() { return even_fabric(Eigen::Vector3d(1, 1, 0).asDiagonal(), 1.0 / 2.0, 1.0 / 8.0); }
} // namespace dem
