#pragma once

#include "apps/models/region.h"
#include "base/entry_path.h"

#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Regions": particles, or nodes, whose centre lies within are of its material. */
  struct MaterialRegion
  {
    std::string name, material;
    Region      region;
  };

  /** @param known names of the materials @throws base::InputError */
  void check_regions(const std::list<MaterialRegion> &regions,
                     const std::vector<std::string>  &known,
                     const base::EntryPath           &root,
                     int                              dimension);

  /** Number the materials of places by the regions, of which later ones win; elsewhere the numbers stay. */
  void number_by_regions(const std::list<MaterialRegion>    &regions,
                         const std::vector<std::string>     &known,
                         const std::vector<Eigen::Vector3d> &places,
                         int                                 dimension,
                         std::vector<std::int32_t>          &numbers);
} // namespace apps
