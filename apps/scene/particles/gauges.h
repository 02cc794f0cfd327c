#pragma once

#include "apps/runs/particles/gauges.h"

namespace apps
{
  class Section;

  void declare(Section &section, GaugeSection &gauge);
  void declare(Section &root, GaugesSection &gauges);
} // namespace apps
