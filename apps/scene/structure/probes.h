#pragma once

#include "apps/runs/structure/probes.h"

namespace apps
{
  class Section;

  void declare(Section &root, DisplacementProbesSection &displacement_probes);
} // namespace apps
