#include "dem/facets/beside.h"

#include "dem/facets/footprint.h"
#include "dem/neighbours/cell_list.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Particles in the box around those that have a facet near, grown by as far as two footprints reach. */
    std::vector<std::int32_t> around(const std::vector<std::int32_t> &listed, const Particles &particles, double margin)
    {
      Eigen::AlignedBox3d box;
      double              largest = 0;
      for (std::size_t i = 0; i < particles.count; ++i)
        largest = std::max(largest, particles.radius_of(i));
      const double reach = 2 * Footprint::widest * largest + margin;
      for (const std::int32_t i : listed)
        box.extend(particles.position_of(static_cast<std::size_t>(i)));
      box.min().array() -= reach;
      box.max().array() += reach;
      std::vector<std::int32_t> found;
      for (std::size_t i = 0; i < particles.count; ++i)
        if (box.contains(particles.position_of(i)))
          found.push_back(static_cast<std::int32_t>(i));
      return found;
    }
  } // namespace

  void Beside::update(const NearFacets &near, const Particles &particles)
  {
    if (made_at == near.searches())
      return;
    made_at = near.searches();
    others.clear();
    const std::vector<std::int32_t> &listed = near.particles();
    from.assign(listed.size() + 1, 0);
    if (listed.empty())
      return;
    const double                    margin     = 2 * near.good_for(); // both may move
    const std::vector<std::int32_t> candidates = around(listed, particles, margin);
    std::vector<Eigen::Vector3d>    centre;
    std::vector<double>             radius;
    for (const std::int32_t i : candidates)
      {
        centre.push_back(particles.position_of(static_cast<std::size_t>(i)));
        radius.push_back(particles.radius_of(static_cast<std::size_t>(i)));
      }
    const auto number = [&](const std::int32_t particle) { // among those listed; their count: it is none of them
      const auto at = std::lower_bound(listed.begin(), listed.end(), particle);
      return at != listed.end() && *at == particle ? static_cast<std::size_t>(at - listed.begin()) : listed.size();
    };
    std::vector<std::pair<std::size_t, std::int32_t>> found;
    for (const NeighbourPair &pair : find_pairs(centre, radius, Footprint::widest, margin, std::nullopt))
      {
        const std::int32_t i = candidates[static_cast<std::size_t>(pair.first)],
                           j = candidates[static_cast<std::size_t>(pair.second)];
        if (number(i) < listed.size())
          found.emplace_back(number(i), j);
        if (number(j) < listed.size())
          found.emplace_back(number(j), i);
      }
    std::sort(found.begin(), found.end());
    for (const auto &[k, other] : found)
      {
        ++from[k + 1];
        others.push_back(other);
      }
    for (std::size_t k = 1; k < from.size(); ++k)
      from[k] += from[k - 1];
  }
} // namespace dem
