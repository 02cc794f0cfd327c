#include "coupling/multiscale/crack_band.h"

#include "coupling/multiscale/ellipticity.h"
#include "fem/materials/response.h"

#include <Eigen/LU>

#include <algorithm>

namespace coupling
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  CrackBand::CrackBand(const Vector3d        &normal,
                       const double           share_,
                       const base::Voigt     &strain,
                       const base::Voigt     &stress,
                       const base::Stiffness &unloading_,
                       const double           stored)
    : direction(normal)
    , share(share_)
    , stored_then(stored)
    , strain_then(strain)
    , stress_then(stress)
    , unloading(unloading_)
  {
  }

  base::Voigt CrackBand::outside(const base::Voigt &strain) const
  {
    return strain - share * (jump_strain(direction) * trial_jump);
  }

  Matrix3d CrackBand::of_jump(const base::Stiffness &of_cell) const
  {
    const Eigen::Matrix<double, 6, 3> N = jump_strain(direction);
    return N.transpose() * ((1 - share) * of_cell + share * unloading) * N;
  }

  CrackBand::Answer CrackBand::respond(const base::Voigt &strain, const Cell &cell)
  {
    constexpr int                     most      = 30;
    constexpr double                  tolerance = 1e-9, little = 1e-4; // of the traction
    const Eigen::Matrix<double, 6, 3> N    = jump_strain(direction);
    const double                      rest = 1 - share;
    trial_jump                             = last ? Vector3d(last->jump + last->rate * (strain - last->strain)) : jump;
    base::Stiffness of_cell;
    double          before = 1; // what was missing where `of_cell` was found
    for (int i = 0; i < most; ++i)
      {
        const base::Voigt in_band = cell.stress(strain + rest * (N * trial_jump));
        const base::Voigt beside  = stress_then + unloading * (outside(strain) - strain_then);
        const Vector3d    missing = N.transpose() * (in_band - beside);
        const double      size    = std::max(beside.norm(), 1e-6 * stress_then.norm());
        const bool        is_done = missing.norm() <= tolerance * size;
        if (!is_done || before > little)
          of_cell = cell.tangent();
        if (is_done)
          return {share * in_band + rest * beside, tangent_of_whole(strain, of_cell)};
        before                 = missing.norm() / size;
        const Matrix3d inverse = of_jump(of_cell).inverse();
        if (!inverse.allFinite())
          break;
        trial_jump -= inverse * missing;
      }
    throw fem::MaterialFailure("the crack band and the parts beside it find no common traction. Shorten the step.");
  }

  base::Stiffness CrackBand::tangent_of_whole(const base::Voigt &strain, const base::Stiffness &of_cell)
  {
    // In a stable solid the layers hold each other: otherwise the band snaps open.
    const Matrix3d K = of_jump(of_cell);
    if (!(K.determinant() > 0))
      throw fem::MaterialFailure("the crack band snaps back: the element is too wide for its cell along the normal.");
    const Eigen::Matrix<double, 6, 3> N          = jump_strain(direction);
    const base::Stiffness             difference = of_cell - unloading;
    const Eigen::Matrix<double, 3, 6> rate       = -K.inverse() * N.transpose() * difference;
    last                                         = Found{strain, trial_jump, rate};
    return share * of_cell + (1 - share) * unloading + share * (1 - share) * difference * N * rate;
  }

  double CrackBand::stored_outside(const base::Voigt &strain) const
  {
    const base::Voigt change = outside(strain) - strain_then;
    return (1 - share) * (stored_then + change.dot(stress_then + 0.5 * (unloading * change)));
  }

  void CrackBand::visit_state(base::StateVisitor &visitor)
  {
    base::Column row;
    const auto   put = [&](const auto &m) { row.insert(row.end(), m.data(), m.data() + m.size()); };
    put(direction), put(jump), put(strain_then), put(stress_then), put(unloading);
    visitor.column("crack_band", row);
    const double *next = row.data();
    const auto    take = [&](auto &m) { std::copy_n(next, m.size(), m.data()), next += m.size(); };
    take(direction), take(jump), take(strain_then), take(stress_then), take(unloading);
    trial_jump = jump;
    begin_step();
    visitor.scalar("share", share);
    visitor.scalar("stored_then", stored_then);
  }
} // namespace coupling
