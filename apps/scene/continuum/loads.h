#pragma once

#include "apps/runs/continuum/loads.h"

namespace apps
{
  class Section;

  void declare(Section &root, LoadsSection &loads);
} // namespace apps
