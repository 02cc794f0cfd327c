#pragma once

#include "base/matrix6.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace coupling
{
  /** How a place in a solid moves. */
  struct PlaceMotion
  {
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero(); ///< [m]
    Eigen::Vector3d rotation     = Eigen::Vector3d::Zero(); ///< half the curl of the displacement [-]
    Eigen::Vector3d element      = Eigen::Vector3d::Zero(); ///< centre of the element that it lies in, undeformed [m]

    base::Vector6 motion() const ///< displacement, then rotation
    {
      base::Vector6 both;
      both << displacement, rotation;
      return both;
    }
  };

  /** Of several places; none where one lies in no element. */
  using PlaceMotions = std::vector<std::optional<PlaceMotion>>;
} // namespace coupling
