#pragma once

#include "apps/runs/particles/model.h"

#include <string>

namespace apps
{
  /** A line of `check` where particles without bonds fall, and local damping takes part of their weight; "" otherwise. */
  std::string damped_fall_line(const ParticlesModel &model);
} // namespace apps
