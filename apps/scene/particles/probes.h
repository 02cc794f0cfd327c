#pragma once

#include "apps/runs/particles/probes.h"

namespace apps
{
  class Section;

  void declare(Section &section, ProbeSection &probe);
  void declare(Section &root, ProbesSection &probes);
} // namespace apps
