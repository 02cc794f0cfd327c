#pragma once

#include "apps/runs/particles/more_particles.h"

namespace apps
{
  class Section;

  void declare(Section &section, AddedParticles &added_particles);
  void declare(Section &root, MoreParticlesSection &more_particles);
} // namespace apps
