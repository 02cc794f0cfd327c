#pragma once

#include "apps/runs/particles/walls.h"

namespace apps
{
  class Section;

  void declare(Section &section, WallSection &wall);
  void declare(Section &root, WallsSection &walls);
} // namespace apps
