#pragma once

#include "dem/network/loaded_network.h"
#include "dem/network/rigid_motions.h"

namespace dem
{
  /**
   * Single particles that would move under the load without any of their own links answering, as on the hinge of two links that meet
   * at a corner of a specimen: no static solution exists with them.
   *
   * @param held in: what of each particle is held; out: with them, as many more of their motions as it takes. The rest of their motions
   *        still follows their links, so that they strain nothing
   */
  std::vector<Mechanism>
  hold_loaded_hinges(const ElasticNetwork &network, std::vector<HeldMotions> &held, const ParticleMotions &load);

  /**
   * Takes the dead load off particles that it would move so, and off those without any link: there is no equilibrium with it.
   * @return them @pre the network has a dead load
   */
  std::vector<Mechanism> unload_hinges(LoadedNetwork &loaded);
} // namespace dem
