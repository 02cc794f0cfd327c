#pragma once

#include "dem/observation/link_images.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace postprocess
{
  /** What of a specimen a picture shows: a slab across one axis, seen along it. */
  struct PictureSlab
  {
    int axis = 1; ///< 0, 1, 2: looking along x, y or z
    std::optional<double>
      position; ///< of its middle plane [m], as the specimen was made; absent: the specimen's middle
    std::optional<double> thickness;   ///< [m]; absent: two mean particle diameters
    double                magnify = 1; ///< displacements are drawn this many times as large, which opens cracks to view
    std::vector<std::string> materials; ///< names for the legend, where several; NAME+2 is NAME
    std::vector<std::string>
      classes; ///< of links, by their pair of materials: cracks of each have a colour; empty: of all one
    std::vector<std::vector<Eigen::Vector2d>> bodies; ///< polygons behind the particles, in the picture's plane [m]
    std::vector<dem::LinkImage>               images; ///< that the links lead to; empty: nothing is periodic
  };

  /**
   * Draw the particles of a slab as circles coloured by damage, and its cracks, into a PNG file. Where there are several materials,
   * particles that are not of the first bear a dot in the colour of theirs.
   *
   * A crack is drawn as the faces between the particles of damaged or broken links that have opened: red segments across the links,
   * the redder the wider (the legend names the opening of full red), by the relative displacement of the two particles along the
   * link. With classes of links those of the first are red, and others of other colours, named in the legend. A link to a periodic image is
   * seen at either side of the cell.
   *
   * @return empty when drawn, otherwise why not; nothing is thrown (see plot()).
   */
  [[nodiscard]] std::string picture_of_specimen(const std::filesystem::path &path,
                                                const dem::ParticleOutput   &particles,
                                                const dem::LinkOutput       &links,
                                                const std::string           &title,
                                                const PictureSlab           &slab = {}) noexcept;
} // namespace postprocess
