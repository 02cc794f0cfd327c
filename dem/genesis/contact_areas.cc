#include "dem/genesis/contact_areas.h"

#include "dem/neighbours/cell_list.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  ContactAreas contact_areas(const Packing &packing, const double gap, const int dimension, const double thickness)
  {
    ContactAreas found;
    for (const NeighbourPair &pair : find_pairs(packing.centre, packing.radius, 1.0, gap, packing.periodic_cell))
      {
        const auto first = static_cast<std::size_t>(pair.first), second = static_cast<std::size_t>(pair.second);
        if (packing.in_one_body(first, second))
          continue;
        const double r = std::min(packing.radius[first], packing.radius[second]);
        ++found.pairs;
        found.area += dimension == 2 ? 2 * r * thickness : M_PI * r * r;
      }
    found.half_area = 0.5 * found.area;
    return found;
  }
} // namespace dem
