#pragma once

#include "dem/model/break_log.h"
#include "postprocess/pictures/specimen_picture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /**
   * Draw what broke where, by how it broke: segments as wide as it was (width_of()), in space those of a slab as they are seen, over the
   * outlines of the particles. Both as they lay when it happened and as they lie now.
   * @param thickness of discs [m]; 0: space
   * @return empty when drawn, otherwise why not; nothing is thrown (see plot()).
   */
  [[nodiscard]] std::string picture_of_breaks(const std::filesystem::path   &path,
                                              const dem::ParticleOutput     &particles,
                                              const std::vector<dem::Break> &breaks,
                                              double                         thickness,
                                              const std::string             &title,
                                              const PictureSlab             &slab = {}) noexcept;

  /** Directions of cracks in a plane in equal sectors of [0, 180) degrees from the first axis, by area. */
  struct BreakDirections
  {
    static constexpr int sectors = 18;

    std::vector<double> tension = std::vector<double>(sectors, 0.0),
                        others  = std::vector<double>(sectors, 0.0); ///< [m^2]

    double total() const;
  };
  /** @param looking_along axis across which the plane lies: 0, 1, 2. A crack lies across its bond; what is seen from the front does not count */
  BreakDirections directions_of(const std::vector<dem::Break> &breaks, int looking_along);

  /** Draw these as a rose: how much of the area that broke lies in which direction. @return see above */
  [[nodiscard]] std::string picture_of_directions(const std::filesystem::path   &path,
                                                  const std::vector<dem::Break> &breaks,
                                                  int                            looking_along,
                                                  const std::string             &title) noexcept;
} // namespace postprocess
