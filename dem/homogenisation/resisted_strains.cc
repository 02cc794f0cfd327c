#include "dem/homogenisation/resisted_strains.h"

#include "dem/core/symmetric_modes.h"
#include "dem/network/mechanisms.h"

#include <vector>

namespace dem
{
  namespace
  {
    /** The strains that exist: in the plane 11 22 12. */
    std::vector<int> components(const int dimension)
    {
      return dimension == 3 ? std::vector<int>{0, 1, 2, 3, 4, 5} : std::vector<int>{0, 1, 5};
    }

    Eigen::MatrixXd existing_part(const MacroscopicStiffness &D, const std::vector<int> &kept)
    {
      const auto      n = static_cast<Eigen::Index>(kept.size());
      Eigen::MatrixXd part(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          part(i, j) = D(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]);
      return part;
    }
  } // namespace

  int remove_unresisted(MacroscopicStiffness &D, const MacroscopicStiffness &bound, const int dimension)
  {
    const std::vector<int>                      kept     = components(dimension);
    const Eigen::MatrixXd                       part     = existing_part(D, kept);
    const SymmetricModes                        own      = symmetric_modes(0.5 * (part + part.transpose()));
    const Eigen::VectorXd                       scale    = symmetric_modes(existing_part(bound, kept)).values;
    const double                                least    = negligible_stiffness * scale.maxCoeff();
    const Eigen::Array<bool, Eigen::Dynamic, 1> resisted = own.values.array() > least;
    if (!resisted.all())
      {
        const Eigen::VectorXd eigenvalues = resisted.select(own.values, 0.0);
        const Eigen::MatrixXd cleaned     = own.vectors * eigenvalues.asDiagonal() * own.vectors.transpose();
        for (std::size_t i = 0; i < kept.size(); ++i)
          for (std::size_t j = 0; j < kept.size(); ++j)
            D(kept[i], kept[j]) = cleaned(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    return static_cast<int>(resisted.count());
  }
} // namespace dem
