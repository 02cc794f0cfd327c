#pragma once

#include "dem/measures/damage_tensor.h"
#include "dem/specimen/results.h"

namespace dem
{
  /** The cohesive links that a specimen was made with, deleted ones included, as damage tensors take them. */
  struct CohesiveDamage
  {
    std::vector<std::array<std::size_t, 2>> ends; ///< particle numbers of the packing
    std::vector<LinkDamage>
      links; ///< strength lost and direction now; of deleted links 1 and the direction they last had
    std::vector<Eigen::Vector3d>
      contact; ///< where each link's force acts, or last acted [m]: to choose those of a region
  };

  /** Of a link of a specimen. */
  LinkDamage damage_of(const LinkOutput &links, std::size_t l);

  /** Contacts, which never had strength to lose, are left out (doc/theory/sequential-transfer.md, 1). */
  CohesiveDamage cohesive_damage(const LinkOutput &links);
} // namespace dem
