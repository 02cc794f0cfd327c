#include "dem/genesis/cages.h"

#include "dem/genesis/inscribed.h"
#include "dem/neighbours/cell_list.h"

#include <algorithm>
#include <vector>

namespace dem
{
  using Eigen::Vector3d;

  namespace
  {
    /** Walls, and the nearest of its neighbours as they are now. */
    std::vector<Obstacle> around(const Packing                  &packing,
                                 const std::size_t               particle,
                                 const std::vector<std::size_t> &neighbours,
                                 const Vessel                   &vessel,
                                 const double                    reach)
    {
      const std::size_t     most  = vessel.dimension == 2 ? 12 : 16;
      const Vector3d       &place = packing.centre[particle];
      std::vector<Obstacle> found;
      for (const std::size_t other : neighbours)
        {
          const Obstacle obstacle{packing.centre[other], packing.radius[other], Vector3d::Zero(), 0};
          if (obstacle.distance(place) < reach)
            found.push_back(obstacle);
        }
      const auto nearer = [&](const Obstacle &a, const Obstacle &b) { return a.distance(place) < b.distance(place); };
      std::sort(found.begin(), found.end(), nearer);
      if (found.size() > most)
        found.resize(most);
      for (const WallTouch &wall : vessel.near(place, 0, reach))
        found.push_back({Vector3d::Zero(), 0, wall.inward, wall.inward.dot(place) - wall.gap});
      return found;
    }
  } // namespace

  void fit_into_cages(Packing                                &packing,
                      const Vessel                           &vessel,
                      const std::function<bool(std::size_t)> &is_floater,
                      const double                            enlargement,
                      const double                            overlap)
  {
    constexpr double                      range = 2; ///< of neighbours, over the sum of both radii
    std::vector<std::vector<std::size_t>> neighbours(packing.size());
    for (const NeighbourPair &pair : find_pairs(packing.centre, packing.radius, range, 0, std::nullopt))
      for (const auto &[one, other] : {std::pair{pair.first, pair.second}, std::pair{pair.second, pair.first}})
        if (is_floater(static_cast<std::size_t>(one)))
          neighbours[static_cast<std::size_t>(one)].push_back(static_cast<std::size_t>(other));
    for (std::size_t i = 0; i < packing.size(); ++i)
      {
        if (!is_floater(i))
          continue;
        const double radius = packing.radius[i], most = enlargement * radius;
        const auto fitted = inscribed_sphere(around(packing, i, neighbours[i], vessel, range * most), vessel.dimension,
                                             packing.centre[i], 2 * radius);
        if (!fitted)
          continue;
        packing.centre[i] = fitted->centre;
        packing.radius[i] = std::clamp(fitted->radius + overlap, radius, most);
      }
  }
} // namespace dem
