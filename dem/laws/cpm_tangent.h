#pragma once

#include "dem/laws/cpm_extended.h"

#include <Eigen/Core>

namespace dem
{
  /** One update of a CPM link, as its linearisation needs it. */
  struct CpmUpdate
  {
    double          normal_strain = 0; ///< without its plastic part
    double          closed_slope  = 1; ///< of the normal stress of a closed link, over E: below 1 where it flows
    Eigen::Vector3d total_shear   = {0, 0, 0}; ///< eps_T at the end of the update
    Eigen::Vector3d trial_shear   = {0, 0, 0}; ///< eps_T - eps_T^p before the return to the strength
    double          kappa = 0, damage = 0;     ///< at the end of the update
    bool            grows  = false;            ///< damage grew in the update, or is about to
    bool            slides = false;            ///< the shear stress was returned to the strength, or is about to be
  };

  /**
   * Consistent (algorithmic) tangent d stress / d strain of the update [Pa] for the strain vector eps = eps_N n + eps_T;
   * doc/theory/cpm.md, 5. Negative along the link on the softening branch; unsymmetric where the link slides, because
   * its strength depends on normal stress and damage.
   */
  Eigen::Matrix3d cpm_tangent(const CpmConstants &law, const Eigen::Vector3d &direction, const CpmUpdate &update);
  Eigen::Matrix3d
  cpm_tangent(const CpmExtendedConstants &law, const Eigen::Vector3d &direction, const CpmUpdate &update);

  /**
   * Secant of the same, symmetric and positive: open links as damaged as they are, sliding links as soft as stress over trial stress.
   * Both keep a small part of their stiffness (1e-6 and 1e-3): it only steers an iteration, which must not lose a particle.
   */
  Eigen::Matrix3d cpm_secant(const CpmConstants &law, const Eigen::Vector3d &direction, const CpmUpdate &update);
  Eigen::Matrix3d
  cpm_secant(const CpmExtendedConstants &law, const Eigen::Vector3d &direction, const CpmUpdate &update);
} // namespace dem
