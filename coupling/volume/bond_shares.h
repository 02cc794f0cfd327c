#pragma once

#include "coupling/volume/overlap.h"
#include "dem/specimen/specimen.h"

#include <vector>

namespace coupling
{
  /** Share of bonds in a place; particles of another body may be beyond the overlap, and share with nobody. */
  double share_of_bonds(const Overlap &overlap, const Eigen::Vector3d &place);

  /** The cohesive bonds of one particle. */
  struct BondShare
  {
    double sum    = 0; ///< of their shares
    int    number = 0; ///< how many there are
    int    whole  = 0; ///< how many there would be if particles did not end with the overlap
  };

  /**
   * Of each particle, by packing number. Where particles end with the overlap, each bond that goes inward has lost its counterpart
   * (doc/theory/volume-coupling.md, 2).
   */
  std::vector<BondShare> bond_shares(const dem::Specimen &specimen, const Overlap &overlap);
} // namespace coupling
