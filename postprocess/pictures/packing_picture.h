#pragma once

#include "dem/model/packing.h"

#include <filesystem>
#include <string>

namespace postprocess
{
  /**
   * Draw the particles of a packing as circles into a PNG file, seen along z: coloured by diameter, or by
   * material where there are several. Of spheres those near the middle plane are drawn.
   *
   * @return empty when drawn, otherwise why not; nothing is thrown
   */
  [[nodiscard]] std::string
  picture_of_packing(const std::filesystem::path &path, const dem::Packing &packing, const std::string &title) noexcept;
} // namespace postprocess
