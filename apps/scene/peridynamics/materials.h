#pragma once

#include "apps/runs/peridynamics/materials.h"

namespace apps
{
  class Section;

  void declare(Section &section, PeridynamicConstants &peridynamic_constants);
  void declare(Section &section, PeridynamicInterface &peridynamic_interface);
  void declare(Section &root, PeridynamicMaterialsSection &peridynamic_materials);
} // namespace apps
