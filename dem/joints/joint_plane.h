#pragma once

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /**
   * A planar joint: all of a plane (in two dimensions a line), or a part of it. Part of it is what lies within `radius` of the centre (a
   * disc, a piece of a line), or between its corners.
   */
  struct JointPlane
  {
    Eigen::Vector3d              centre = {0, 0, 0}; ///< on the plane [m]
    Eigen::Vector3d              normal = {0, 1, 0}; ///< unit vector
    double                       radius = 0;         ///< [m]; 0: no bound of this kind
    std::size_t                  set    = 0;         ///< number of the set that it is one of
    std::vector<Eigen::Vector3d> corners; ///< of a polygon on the plane, or both ends of a segment [m]; empty: none
  };

  /** Joint between two ends, in the plane. @throws base::InputError if they are one place */
  JointPlane segment_joint(const Eigen::Vector3d &from, const Eigen::Vector3d &to);
  /** Joint of at least three corners, in their order around it. @throws base::InputError unless they lie on a plane, and span an area */
  JointPlane polygon_joint(const std::vector<Eigen::Vector3d> &corners);
  /**
   * Normal of a plane that dips so much [degrees]: in two dimensions a line that rises so much from x towards y; in three a plane
   * steepest downwards towards dip_direction, which is counted from x towards y.
   */
  Eigen::Vector3d normal_of_dip(double dip, double dip_direction, int dimension);

  /** Whether the straight line between two places crosses the joint. @param crossing receives where, if it does */
  bool crosses(const JointPlane      &joint,
               const Eigen::Vector3d &one,
               const Eigen::Vector3d &other,
               int                    dimension,
               Eigen::Vector3d       &crossing);

  /**
   * Area of a joint within a box [m^2], in two dimensions its length [m]. A disc counts as a polygon of its area, with many corners.
   */
  double
  extent_in_box(const JointPlane &joint, const Eigen::Vector3d &lower, const Eigen::Vector3d &upper, int dimension);
} // namespace dem
