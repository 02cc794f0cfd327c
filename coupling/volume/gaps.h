#pragma once

#include "coupling/volume/bond_shares.h"
#include "coupling/volume/parameters.h"
#include "fem/solid/solid.h"

namespace coupling
{
  /**
   * Refuses a region and an overlap that particles do not fill: space that elements leave there to particles, or hand over to them, would be empty.
   * Every place of the elements in the overlap must be near a particle that bonds join to the region, along each axis by one and a half
   * times the longest bond of that particle; for constrained particles, every place from which bonds reach the region. In the place of
   * each element that the region has taken there must be such a particle, but for places that are meant to be empty, and pieces of the
   * packing that no bond joins must not come together there. Without bonds nothing is checked.
   * @throws base::InputError with the box around the places that are not filled, and how far they are from the nearest particle
   */
  template <int dim>
  void
  refuse_gaps(const fem::Solid<dim> &solid, const BondedParticles &particles, const VolumeCouplingParameters &coupling);
} // namespace coupling
