#pragma once

#include "base/voigt.h"

#include <Eigen/Core>

namespace coupling
{
  /** The plane across which a material is nearest to a jump of its strain rate. */
  struct WeakestPlane
  {
    Eigen::Vector3d normal = {1, 0, 0}; ///< n, unit
    double left = 1; ///< det Q(n) of the tangent over that of the elastic stiffness; 0 or less: ellipticity is lost

    bool is_lost() const { return left <= 0; }
  };

  /**
   * Smallest determinant of the acoustic tensor Q(n) = n . D . n over all directions, measured with the elastic one of the same direction
   * (Rudnicki and Rice, 1975, JMPS 23, 371): a search over directions, the best of which are refined.
   *
   * @param tangent [Pa], need not be symmetric @param elastic [Pa], positive definite
   * @param in_plane normals in the plane x y alone, as a model in plane strain can have
   */
  WeakestPlane weakest_plane(const base::Stiffness &tangent, const base::Stiffness &elastic, bool in_plane);

  /**
   * Of all planes that a tangent has lost by now, the one lost first while the stiffness goes straight from the unloading one to it: that
   * which bears the least softening. A state far past the loss has lost many planes, and the smallest determinant is then chance.
   *
   * @param unloading [Pa], positive definite @param tangent [Pa], of which weakest_plane() is lost
   */
  Eigen::Vector3d first_lost_normal(const base::Stiffness &unloading,
                                    const base::Stiffness &tangent,
                                    const base::Stiffness &elastic,
                                    bool                   in_plane);

  /** The strain (engineering shears) of a jump a of the displacement gradient across a plane, a n^T: 6 x 3, times a. */
  Eigen::Matrix<double, 6, 3> jump_strain(const Eigen::Vector3d &normal);
} // namespace coupling
