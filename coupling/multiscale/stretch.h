#pragma once

#include "base/voigt.h"

#include <Eigen/Core>

namespace coupling
{
  /**
   * A law of small strains seen by a solid that moves and turns far: F = R U, the law answers to U - 1 with T, work-conjugate to U
   * (Biot's stress), and the solid wants S, work-conjugate to its Green strain E = (U U - 1)/2. Rotations are in neither
   * (doc/theory/multiscale.md, 4).
   */
  class Stretch
  {
  public:
    /** @param green E, engineering shears @throws fem::MaterialFailure where U has no positive stretches */
    explicit Stretch(const base::Voigt &green);

    base::Voigt strain() const; ///< U - 1, engineering shears

    /** S [Pa] of the law's stress. */
    base::Voigt stress(const base::Voigt &of_law) const { return by_green.transpose() * of_law; }
    /** dS/dE [Pa] of its stress and tangent. */
    base::Stiffness tangent(const base::Voigt &of_law, const base::Stiffness &tangent_of_law) const;

  private:
    Eigen::Matrix3d divided(const Eigen::Matrix3d &tensor) const; ///< X of X U + U X = tensor

    Eigen::Matrix3d axes;
    Eigen::Vector3d stretches;
    base::Stiffness by_green; ///< d (U - 1) / dE
  };
} // namespace coupling
