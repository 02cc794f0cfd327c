#pragma once

#include "base/voigt.h"
#include "coupling/volume/overlap.h"
#include "dem/network/elastic_network.h"
#include "fem/solid/solid.h"

#include <vector>

namespace coupling
{
  /** What particles of an overlap are to the elements that fill the same space. */
  struct OverlapMedium
  {
    /** Where every particle moves evenly with the strain: of lattices what they are, of packings an upper bound [Pa]. */
    base::Stiffness stiffness    = base::Stiffness::Zero();
    double          density      = 0; ///< [kg/m^3]
    double          longest_bond = 0; ///< with an end in the overlap [m]
  };

  /** @param masses of all particles, by number [kg] @param overlap some volume of the solid lies in it, else all is zero */
  template <int dim>
  OverlapMedium medium_in_overlap(const dem::ElasticNetwork &network,
                                  const std::vector<double> &masses,
                                  const fem::Solid<dim>     &solid,
                                  const Overlap             &overlap);
} // namespace coupling
