#pragma once

#include "dem/specimen.h"

#include <filesystem>
#include <limits>
#include <string>

namespace postprocess
{
  /** What of a specimen a picture shows: a slab across one axis, seen along it. */
  struct PictureSlab
  {
    int    axis = 1; ///< 0, 1, 2: looking along x, y or z
    double position =
      std::numeric_limits<double>::quiet_NaN(); ///< of the middle plane [m]; NaN: middle of the specimen
    double thickness = std::numeric_limits<double>::quiet_NaN(); ///< [m]; NaN: two mean particle diameters
    double magnify   = 1;                                        ///< displacements are drawn this many times as large
  };

  /**
   * Draw the particles of a slab as circles coloured by damage, with its broken links as red segments, into a PNG file.
   *
   * @return empty when drawn, otherwise why not; never throws (see plot()).
   */
  [[nodiscard]] std::string picture_of_specimen(const std::filesystem::path &path,
                                                const dem::ParticleOutput   &particles,
                                                const dem::LinkOutput       &links,
                                                const std::string           &title,
                                                const PictureSlab           &slab = {}) noexcept;
} // namespace postprocess
