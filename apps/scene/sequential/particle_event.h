#pragma once

#include "apps/runs/sequential/particle_event.h"

namespace apps
{
  class Section;

  void declare(Section &root, ParticleEventSection &particle_event);
} // namespace apps
