#pragma once

#include "coupling/volume/bond_shares.h"
#include "coupling/volume/parameters.h"
#include "fem/solid/solid.h"

namespace coupling
{
  /**
   * Refuses an overlap that particles do not fill: what elements leave there to particles, or hand on to them, would be nobody's, and the
   * body cut in two. Every place of the elements in it must be near a particle that bonds join to the region, along each axis by one and
   * a half times the longest bond of that particle; where particles are slaved, every place from which bonds reach the region. Without bonds nothing is
   * looked at.
   * @throws base::InputError with the box around the places that are not
   */
  template <int dim>
  void
  refuse_gaps(const fem::Solid<dim> &solid, const BondedParticles &particles, const VolumeCouplingParameters &coupling);
} // namespace coupling
