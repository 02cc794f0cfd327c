#pragma once

#include "apps/runs/particles/clumps.h"

namespace apps
{
  class Section;

  void declare(Section &root, ClumpsSection &clumps);
} // namespace apps
