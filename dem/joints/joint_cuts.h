#pragma once

#include "dem/joints/joint_plane.h"
#include "dem/model/packing.h"

#include <cstddef>
#include <vector>

namespace dem
{
  /** Up to which distance a specimen links its particles; see SpecimenParameters. */
  struct JointedSpecimen
  {
    int         dimension         = 3;
    double      thickness         = 0; ///< of discs [m]
    double      interaction_ratio = 1;
    double      installation_gap  = 0; ///< [m]
    std::size_t particles         = 0; ///< the first so many can be cut
  };

  /** What a joint has cut. */
  struct CutFigures
  {
    std::size_t     set    = 0;         ///< that the joint is one of
    Eigen::Vector3d normal = {0, 1, 0}; ///< of the joint
    std::size_t     links  = 0;
    double          area   = 0; ///< of the joint within the body, which its links share [m^2]
  };

  /** Number of `Packing::cuts`, sorted, and figures of each joint. */
  struct JointCuts
  {
    std::vector<JointCut>   cuts;
    std::vector<CutFigures> of_joint; ///< as many as there are joints
  };

  /**
   * The pairs of particles whose centres a joint lies between: all that are or may come near, up to twice the sum of their radii, of which
   * those within the specimen's distance are linked. A pair that several joints cut is the first one's.
   *
   * The links of a joint share its area within the body, by their own cross-sections (doc/theory/smooth-joint.md, 4). That is the smaller
   * of its area in the bounding box of the particles and of the hull of the places where links cross it, widened by one and a half mean
   * radii, by which outermost crossings lie inside the surface: across the sides at which a joint all through the body ends.
   */
  JointCuts find_cuts(const Packing &packing, const JointedSpecimen &specimen, const std::vector<JointPlane> &joints);
} // namespace dem
