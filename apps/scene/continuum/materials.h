#pragma once

#include "apps/runs/continuum/materials.h"

namespace apps
{
  class Section;

  /** @param holds_particles whether particles can be inside the solid, whose material may be homogenised */
  void declare(Section                     &section,
               MaterialOfGroup             &material_of_group,
               const std::function<bool()> &is_explicit,
               bool                         holds_particles);
  void
  declare(Section &root, MaterialsSection &materials, std::function<bool()> is_explicit, bool holds_particles = false);
} // namespace apps
