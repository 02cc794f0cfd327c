#pragma once

#include "base/mandel.h"

#include <vector>

namespace dem
{
  /** Mean products of link directions (fabric of the first kind; Kanatani, 1984, Int. J. Eng. Sci. 22, 149; doc/theory/stress-and-fabric.md, 4). */
  struct Fabric
  {
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero(); ///< <n (x) n>, trace 1
    base::Matrix6   fourth = base::Matrix6::Zero();   ///< <n (x) n (x) n (x) n> as a Mandel matrix
    double          weight = 0;                       ///< sum of weights (their number when unweighted)
  };

  /**
   * Fabric of unit directions; n and -n count alike.
   * @param weights one per direction, e.g. length times area; empty: all 1
   * @throws std::invalid_argument if the numbers differ, there is no direction, or the weights do not sum to more than zero
   */
  Fabric fabric(const std::vector<Eigen::Vector3d> &directions, const std::vector<double> &weights = {});

  /** What fabric() gives for directions spread evenly: d_ij/3 and (d_ij d_kl + d_ik d_jl + d_il d_jk)/15 (Bazant, Oh, 1986). */
  Fabric isotropic_fabric();

  /** The same on the circle in the plane z = 0: d_ij/2 and (d_ij d_kl + d_ik d_jl + d_il d_jk)/8. */
  Fabric plane_isotropic_fabric();
} // namespace dem
