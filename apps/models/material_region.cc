#include "apps/models/material_region.h"

#include "apps/text/nearest_name.h"

#include <algorithm>

namespace apps
{
  void check_regions(const std::list<MaterialRegion> &regions,
                     const std::vector<std::string>  &known,
                     const base::EntryPath           &root,
                     const int                        dimension)
  {
    for (const MaterialRegion &region : regions)
      {
        const base::EntryPath section = root.at("Regions").at(region.name);
        if (std::find(known.begin(), known.end(), region.material) == known.end())
          section.refuse("Material", "is not in section Materials. " + did_you_mean(region.material, known));
        region.region.check(section, dimension);
      }
  }

  void number_by_regions(const std::list<MaterialRegion>    &regions,
                         const std::vector<std::string>     &known,
                         const std::vector<Eigen::Vector3d> &places,
                         const int                           dimension,
                         std::vector<std::int32_t>          &numbers)
  {
    for (const MaterialRegion &region : regions)
      {
        const auto number =
          static_cast<std::int32_t>(std::find(known.begin(), known.end(), region.material) - known.begin());
        for (std::size_t i = 0; i < places.size(); ++i)
          if (region.region.holds(places[i], dimension))
            numbers[i] = number;
      }
  }
} // namespace apps
