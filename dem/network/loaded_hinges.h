#pragma once

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
} // namespace dem
