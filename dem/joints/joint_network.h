#pragma once

#include "dem/joints/joint_plane.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** A random network of joints of one size, and of directions around a mean one. */
  struct JointNetwork
  {
    int             dimension = 3;
    Eigen::Vector3d lower = {0, 0, 0}, upper = {0, 0, 0}; ///< of the box that it fills [m]
    double          intensity = 0; ///< area over volume, P32, in two dimensions length over area, P21 [1/m]; > 0
    double          radius    = 0; ///< of each disc, or half the length of each line [m]; > 0
    Eigen::Vector3d normal    = {0, 1, 0};
    double          concentration =
      0; ///< kappa of the directions about the mean normal [-]; 0: any direction is as likely; infinite: one
    std::uint64_t seed = 1;
  };

  /**
   * Joints with centres anywhere in the box, or beside it by their radius at most, until the asked intensity within it is reached, as
   * nearly as a whole number of them comes to it. Normals follow Fisher's distribution on the sphere (Proc. R. Soc. Lond. A 217 (1953)
   * 295), in two dimensions von Mises' on the circle, drawn as Best and Fisher do (Appl. Stat. 28 (1979) 152). The same for the same seed.
   * Intensities: Dershowitz and Herda, 33rd US Symp. Rock Mech. (1992).
   *
   * @throws base::InputError naming the number that is out of range, or an intensity that takes more than a hundred thousand joints
   */
  std::vector<JointPlane> random_joints(const JointNetwork &network);
} // namespace dem
