#include "dem/contacts/particle_pairs.h"

#include <algorithm>

namespace dem
{
  std::vector<NeighbourPair>
  particle_pairs(const Particles &particles, const double factor, const double skin, const PairsOf &of)
  {
    std::vector<Eigen::Vector3d> centre(particles.count);
    std::vector<double>          radius(particles.count);
    double                       largest = 0;
    for (std::size_t i = 0; i < particles.count; ++i)
      {
        centre[i] = particles.position_of(i);
        radius[i] = particles.radius_of(i);
        largest   = std::max(largest, radius[i]);
      }
    if (!particles.cell.repeats())
      return find_pairs(centre, radius, factor, skin, std::nullopt, of);
    Eigen::Matrix3d base = particles.cell.base();
    if (particles.cell.dimension() == 2)
      base(2, 2) = 2 * (2 * factor * largest + skin); // discs have no image above them
    return find_pairs_sheared(centre, radius, factor, skin, base, of);
  }
} // namespace dem
