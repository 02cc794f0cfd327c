#pragma once

#include "postprocess/pictures/specimen_picture.h"

#include <filesystem>
#include <string>

namespace postprocess
{
  /**
   * Draw the forces between particles of a slab: a line from centre to centre, the wider the larger its normal force; compression and
   * tension in colours of their own. Forces below a fiftieth of the largest are left out. With walls, from the particle to where it touches.
   * @return empty when drawn, otherwise why not; nothing is thrown (see plot()).
   */
  [[nodiscard]] std::string picture_of_forces(const std::filesystem::path         &path,
                                              const dem::ParticleOutput           &particles,
                                              const dem::LinkOutput               &links,
                                              const std::vector<dem::WallContact> &walls,
                                              const std::string                   &title,
                                              const PictureSlab                   &slab = {}) noexcept;
} // namespace postprocess
