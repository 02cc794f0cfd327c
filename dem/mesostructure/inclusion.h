#pragma once

#include "dem/mesostructure/convex_shape.h"

#include <Eigen/Core>

#include <memory>

namespace dem
{
  /** An aggregate: a convex shape with a size, a place and a direction. */
  struct Inclusion
  {
    std::shared_ptr<const ConvexShape> shape  = unit_sphere();
    double                             radius = 0; ///< of the sphere of its volume [m]
    Eigen::Vector3d                    centre = Eigen::Vector3d::Zero();
    Eigen::Matrix3d                    axes   = Eigen::Matrix3d::Identity(); ///< columns: those of the shape, in space

    double diameter() const { return 2 * radius; } ///< of the sphere of its volume [m]
    double volume() const;                         ///< [m^3]
    double reach() const { return radius * shape->reach(); }
    /** Its point that lies furthest in a direction [m]. */
    Eigen::Vector3d furthest(const Eigen::Vector3d &direction) const;
    /** How deep a place lies inside; negative outside [m]. */
    double depth(const Eigen::Vector3d &place) const;
  };

  /**
   * Whether the surfaces of two are a gap apart, at least; where the search ends undecided (as good as touching), no.
   *
   * Gilbert (1966), SIAM J. Control 4, 61: a point of the difference of the bodies goes towards the origin; its distance bounds theirs from
   * above, the support in its direction from below (doc/theory/mesostructure.md, 3). Spheres directly.
   * @param gap > 0 [m] @param shift of the other: the image of a periodic box [m]
   */
  bool are_apart(const Inclusion       &one,
                 const Inclusion       &other,
                 double                 gap,
                 const Eigen::Vector3d &shift = Eigen::Vector3d::Zero());
} // namespace dem
