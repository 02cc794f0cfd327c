#pragma once

#include "dem/model/packing.h"

#include <string>

namespace apps
{
  /** The line of a forecast with the extent of a body. */
  std::string extent_line(const Eigen::Vector3d &lower, const Eigen::Vector3d &upper, int dimension);

  /**
   * The lines of a forecast with the extent of the particles, surfaces included, their radii, and how densely
   * they are packed: a file in millimetres shows, and a surface that is sparse. */
  std::string extent_lines(const dem::Packing &packing, int dimension);
} // namespace apps
