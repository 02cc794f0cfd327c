#pragma once

#include "coupling/volume/overlap.h"
#include "dem/network/elastic_network.h"
#include "dem/specimen/observation.h"

#include <vector>

namespace coupling
{
  /** A cohesive link, by the numbers of its particles. */
  struct Bond
  {
    std::size_t     first, second;
    Eigen::Vector3d contact; ///< where both act on each other [m]
    double          length;  ///< from centre to centre, to the nearest image [m]
  };

  /** Particles and what bonds them, as far as shares need them. */
  struct BondedParticles
  {
    std::vector<Eigen::Vector3d> centre; ///< [m]
    std::vector<Bond>            bonds;
  };

  BondedParticles bonded_particles(const dem::ObservedSpecimen &specimen);
  BondedParticles bonded_particles(const dem::ElasticNetwork &network);

  /** Share of bonds in a place; particles of another body may be beyond the overlap, and do not share. */
  double share_of_bonds(const Overlap &overlap, const Eigen::Vector3d &place);

  /** The cohesive bonds of one particle. */
  struct BondShare
  {
    double sum    = 0; ///< of their shares
    int    number = 0; ///< how many there are
    int    whole  = 0; ///< how many there would be if particles did not end with the overlap
  };

  /**
   * Of each particle. Where particles end with the overlap, each bond that goes inward has lost its counterpart
   * (doc/theory/volume-coupling.md, 2).
   */
  std::vector<BondShare> bond_shares(const BondedParticles &all, const Overlap &overlap);

  /**
   * How much of each of some particles lies between the two sides of an overlap, by what the weights of its bonds differ from its own: on
   * these, and no others, do even stresses that share evenly leave a force (doc/theory/static-handshake.md, 2).
   */
  std::vector<double>
  parts_within(const BondedParticles &all, const Overlap &overlap, const std::vector<std::size_t> &particles);
} // namespace coupling
