#include "coupling/volume/bond_shares.h"

#include <algorithm>

namespace coupling
{
  using Eigen::Vector3d;

  namespace
  {
    /** Where the bonds of a particle go. */
    struct BondsAround
    {
      double longest = 0; ///< [m]
      int    inward = 0, outward = 0;
    };
  } // namespace

  double share_of_bonds(const Overlap &overlap, const Vector3d &place)
  {
    constexpr double rounding = 1e-6;
    return overlap.distance(place) > (1 + rounding) * overlap.width ? 1.0 : overlap.of_particles(place);
  }

  std::vector<BondShare> bond_shares(const dem::Specimen &specimen, const Overlap &overlap)
  {
    const std::size_t        count = specimen.counts().particles;
    std::vector<BondShare>   shares(count);
    std::vector<BondsAround> around(count);
    const dem::LinkOutput    links = specimen.links();
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      if (links.kind[l] == dem::LinkOutput::cohesive)
        for (const int end : {0, 1})
          {
            constexpr double  across = 1e-6; // of a bond's length: along the overlap
            const std::size_t here   = links.ends[l][static_cast<std::size_t>(end)],
                              there  = links.ends[l][static_cast<std::size_t>(1 - end)];
            const double length      = links.load[l].branch.norm(),
                         further     = overlap.distance(specimen.particle(there).position) -
                                   overlap.distance(specimen.particle(here).position);
            shares[here].sum += share_of_bonds(overlap, links.load[l].contact);
            ++shares[here].number;
            around[here].inward += further < -across * length;
            around[here].outward += further > across * length;
            around[here].longest = std::max(around[here].longest, length);
          }
    for (std::size_t i = 0; i < count; ++i)
      {
        const Vector3d place = specimen.particle(i).position;
        const bool     ends  = overlap.contains(place) && overlap.distance(place) + around[i].longest > overlap.width;
        shares[i].whole      = shares[i].number + (ends ? std::max(0, around[i].inward - around[i].outward) : 0);
      }
    return shares;
  }
} // namespace coupling
