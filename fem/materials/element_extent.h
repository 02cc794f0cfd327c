#pragma once

#include "base/voigt.h"

#include <array>

namespace fem
{
  /// Size of the element around a material point, as far as a softening law needs it.
  struct ElementExtent
  {
    std::array<Eigen::Vector3d, 8> vertices{}; ///< [m], undeformed
    unsigned int                   n_vertices = 0;
    double                         mean_size  = 0.0; ///< cube root of the volume, in 2d square root of the area [m]

    /// Extent of the projection on a unit vector [m].
    double along(const Eigen::Vector3d &direction) const noexcept;

    /// A point without mesh: every direction has this size [m].
    static ElementExtent uniform(double size) noexcept;
  };
}
