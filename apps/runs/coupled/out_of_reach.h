#pragma once

#include "apps/runs/coupled/model.h"
#include "apps/runs/particles/groups.h"
#include "dem/specimen/observation.h"

#include <string>

namespace apps
{
  /**
   * Lines of a forecast, a warning for each coupling that nothing leads its particles to: neither weight nor a velocity of the start
   * points from any of them to a face of the boundary. None where anything else drives particles or solid.
   */
  std::string couplings_out_of_reach(const CoupledModel          &model,
                                     const dem::ObservedSpecimen &specimen,
                                     const ParticleGroups        &groups);
} // namespace apps
