#pragma once

#include "dem/specimen/results.h"

namespace apps
{
  /** So that a displacement that half of the particles stay below shows as a twentieth of their extent; a round number. */
  double magnification(const dem::ParticleOutput &particles);
} // namespace apps
