#pragma once

#include "apps/runs/particles/forces.h"

namespace apps
{
  class Section;

  void declare(Section &root, ForcesSection &forces);
} // namespace apps
