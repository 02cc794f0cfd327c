#include "coupling/volume/bond_shares.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

    /** By how much the ends of a particle's bonds are further out, or in, than it is. */
    struct Side
    {
      double sum = 0, squares = 0; ///< [m, m^2]
    };
  } // namespace

  double share_of_bonds(const Overlap &overlap, const Vector3d &place)
  {
    constexpr double rounding = 1e-6;
    return overlap.distance(place) > (1 + rounding) * overlap.width ? 1.0 : overlap.of_particles(place);
  }

  BondedParticles bonded_particles(const dem::ObservedSpecimen &specimen)
  {
    BondedParticles all;
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      all.centre.push_back(specimen.particle(i).position);
    const dem::LinkOutput links = specimen.links();
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      if (links.kind[l] == dem::LinkOutput::cohesive)
        all.bonds.push_back({links.ends[l][0], links.ends[l][1], links.load[l].contact, links.load[l].branch.norm()});
    return all;
  }

  BondedParticles bonded_particles(const dem::ElasticNetwork &network)
  {
    BondedParticles all{network.centre, {}};
    for (const dem::ElasticLink &link : network.links)
      {
        const auto first = static_cast<std::size_t>(link.first);
        all.bonds.push_back({first, static_cast<std::size_t>(link.second),
                             network.centre[first] + link.arm_first * link.direction, link.branch.norm()});
      }
    return all;
  }

  std::vector<BondShare> bond_shares(const BondedParticles &all, const Overlap &overlap)
  {
    std::vector<BondShare>   shares(all.centre.size());
    std::vector<BondsAround> around(all.centre.size());
    for (const Bond &bond : all.bonds)
      for (const auto &[here, there] : {std::pair{bond.first, bond.second}, std::pair{bond.second, bond.first}})
        {
          constexpr double across  = 1e-6; // of a bond's length: along the overlap
          const double     further = overlap.distance(all.centre[there]) - overlap.distance(all.centre[here]);
          shares[here].sum += share_of_bonds(overlap, bond.contact);
          ++shares[here].number;
          around[here].inward += further < -across * bond.length;
          around[here].outward += further > across * bond.length;
          around[here].longest = std::max(around[here].longest, bond.length);
        }
    for (std::size_t i = 0; i < shares.size(); ++i)
      {
        const Vector3d &place = all.centre[i];
        const bool      ends  = overlap.contains(place) && overlap.distance(place) + around[i].longest > overlap.width;
        shares[i].whole       = shares[i].number + (ends ? std::max(0, around[i].inward - around[i].outward) : 0);
      }
    return shares;
  }

  std::vector<double>
  parts_within(const BondedParticles &all, const Overlap &overlap, const std::vector<std::size_t> &particles)
  {
    const auto         &centre = all.centre;
    std::vector<double> changed(centre.size(), 0), longest(changed), own(changed);
    std::vector<Side>   inward(centre.size()), outward(inward);
    for (std::size_t i = 0; i < centre.size(); ++i)
      own[i] = std::clamp(1 - overlap.distance(centre[i]) / overlap.width, 0.0, 1.0);
    for (const Bond &bond : all.bonds)
      for (const auto &[here, there] : {std::pair{bond.first, bond.second}, std::pair{bond.second, bond.first}})
        {
          const double further = overlap.distance(centre[there]) - overlap.distance(centre[here]);
          changed[here] += (own[here] - share_of_bonds(overlap, bond.contact)) * further;
          Side &side = (further < 0 ? inward : outward)[here];
          side.sum += std::fabs(further);
          side.squares += further * further;
          longest[here] = std::max(longest[here], bond.length);
        }
    std::vector<double> parts;
    for (const std::size_t i : particles)
      {
        // Where particles end, bonds that go inward have no counterpart: one without any share.
        const bool   ends    = overlap.distance(centre[i]) + longest[i] > overlap.width;
        const double lost    = ends ? own[i] * std::max(0.0, inward[i].sum - outward[i].sum) : 0.0,
                     squares = ends ? 2 * inward[i].squares : inward[i].squares + outward[i].squares;
        parts.push_back(2 * overlap.width * (changed[i] + lost) / squares);
      }
    return parts;
  }
} // namespace coupling
