#include "dem/mesostructure/bodies_apart.h"

#include "dem/mesostructure/mesostructure.h"
#include "dem/neighbours/cell_list.h"

#include <algorithm>
#include <set>

namespace dem
{
  std::vector<std::int32_t> numbers_apart(const Packing                   &packing,
                                          const std::vector<std::int32_t> &aggregate,
                                          const std::size_t                aggregates,
                                          const double                     reach)
  {
    std::vector<std::set<std::int32_t>> near(aggregates);
    for (const NeighbourPair &pair : find_pairs(packing.centre, packing.radius, reach, 0.0, packing.periodic_cell))
      {
        const std::int32_t one   = aggregate[static_cast<std::size_t>(pair.first)],
                           other = aggregate[static_cast<std::size_t>(pair.second)];
        if (one == other || one == in_mortar || other == in_mortar)
          continue;
        near[static_cast<std::size_t>(one)].insert(other);
        near[static_cast<std::size_t>(other)].insert(one);
      }
    constexpr std::int32_t    none = -1;
    std::vector<std::int32_t> number(aggregates, none);
    for (std::size_t a = 0; a < aggregates; ++a)
      {
        std::set<std::int32_t> taken;
        for (const std::int32_t other : near[a])
          taken.insert(number[static_cast<std::size_t>(other)]);
        std::int32_t free = 0;
        while (taken.count(free) > 0)
          ++free;
        number[a] = free;
      }
    return number;
  }
} // namespace dem
