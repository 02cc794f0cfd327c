#pragma once

#include "apps/runs/structure/supports.h"

namespace apps
{
  class Section;

  void declare(Section &root, ParticleSupportsSection &particle_supports);
} // namespace apps
