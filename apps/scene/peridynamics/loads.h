#pragma once

#include "apps/runs/peridynamics/loads.h"

namespace apps
{
  class Section;

  void declare(Section &section, PeridynamicTraction &peridynamic_traction);
  void declare(Section &section, PeridynamicSupport &peridynamic_support);
  void declare(Section &root, PeridynamicLoadsSection &peridynamic_loads);
} // namespace apps
