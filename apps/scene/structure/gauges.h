#pragma once

#include "apps/runs/structure/gauges.h"

namespace apps
{
  class Section;

  void declare(Section &root, DisplacementGaugesSection &displacement_gauges);
} // namespace apps
