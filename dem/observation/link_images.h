#pragma once

#include "dem/specimen/results.h"

#include <vector>

namespace dem
{
  class ObservedSpecimen;

  /** The image that a link of a periodic cell reaches: what to add to the place of its second particle. Zero within the cell. */
  struct LinkImage
  {
    Eigen::Vector3d now = {0, 0, 0}, at_start = {0, 0, 0}; ///< H k: with the cell as it is, and as it was made [m]

    bool is_other() const { return !now.isZero(0); }
  };

  /**
   * The images that links reach. A cohesive link, broken or not, is known by the places at which its particles were bonded, however
   * far they have moved since; a contact by their present places.
   * @param base H of the cell now, columns are the base vectors  @param base_at_start the same when the specimen was made [m]
   */
  std::vector<LinkImage> link_images(const LinkOutput      &links,
                                     const ParticleOutput  &particles,
                                     const Eigen::Matrix3d &base,
                                     const Eigen::Matrix3d &base_at_start);

  /** Of a specimen; empty if nothing is periodic. */
  std::vector<LinkImage>
  link_images(const ObservedSpecimen &specimen, const LinkOutput &links, const ParticleOutput &particles);
} // namespace dem
