#pragma once

#include "apps/runs/particles/initial_velocity.h"

namespace apps
{
  class Section;

  void declare(Section &root, InitialVelocitySection &initial_velocity);
} // namespace apps
