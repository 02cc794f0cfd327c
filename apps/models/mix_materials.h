#pragma once

#include "apps/models/material.h"
#include "apps/models/mix.h"
#include "dem/model/materials.h"

#include <cstddef>
#include <string>
#include <vector>

namespace apps
{
  /**
   * Materials of a mix whose constants follow from those of its mortar: number 0 is the mortar, all others aggregates, all alike. Links know the
   * pair of their materials alone, so that aggregates beside each other are of different numbers, and links between these, as those
   * with the mortar, of the interface.
   *
   * @param mortar section Material @param numbers of materials, at least 1 @throws base::InputError for factors that its law has no constants for
   */
  dem::LinkMaterials mix_materials(const MixSection &mix, const LinkLaw &mortar, std::size_t numbers);

  /**
   * Section Materials, whose mortar and aggregate have constants of their own, with as many further numbers of the aggregate as make so many
   * materials. Links between two of its numbers are of the interface, as those between it and the mortar; with others they are as its own.
   *
   * @pre the section has both and is checked
   */
  MaterialSection with_copies(const MixSection &mix, const MaterialSection &materials, std::size_t numbers);

  /** "mortar", "aggregate" or "interface" of each pair of so many materials, in the order of dem::material_pair(). */
  std::vector<std::string> classes_of_mix(std::size_t numbers);

  /** "aggregate", "aggregate+2", ...: @param copy from 0 @throws base::InputError beyond how many there are */
  std::string aggregate_name(const MixSection &mix, std::int32_t copy);
} // namespace apps
