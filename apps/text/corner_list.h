#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace apps
{
  /** Coordinates of each corner of a body, as many as a scene gives. */
  using CornerList = std::vector<std::vector<double>>;

  /** "0, 0, 0; 1, 0, 0; 0, 1, 0; 0, 0, 1". @throws base::InputError naming the first that is none */
  CornerList corners_in_text(const std::string &text);

  /** As places [m]. @throws base::InputError naming the first that does not have as many coordinates as there are dimensions */
  std::vector<Eigen::Vector3d> places_of(const CornerList &corners, int dimension);
} // namespace apps
