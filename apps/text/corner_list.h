#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace apps
{
  /** "0, 0, 0; 1, 0, 0; 0, 1, 0; 0, 0, 1": places [m], in two dimensions of two coordinates each. @throws base::InputError naming the first that is none */
  std::vector<Eigen::Vector3d> corners_in_text(const std::string &text, int dimension);
} // namespace apps
