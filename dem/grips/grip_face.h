#pragma once

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /** The two axes across another one, in the order of arms_in_face(). */
  inline int across(const int axis, const int which) { return (axis + 1 + which) % 3; }

  /**
   * Where the particles of a grip lie in its face, across the axis of the load: from their middle, along both axes across [m].
   * @throws base::InputError where they lie on a line, in the plane at a point: no face turns about that
   */
  std::vector<Eigen::Vector2d> arms_in_face(const std::vector<Eigen::Vector3d> &places, int axis, int dimension);
} // namespace dem
