#pragma once

#include "apps/runs/particles/stops.h"

namespace apps
{
  class Section;

  void declare(Section &section, StopSection &stop);
  void declare(Section &root, StopsSection &stops);
} // namespace apps
