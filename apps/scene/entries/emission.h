#pragma once

#include "apps/models/emission.h"

namespace apps
{
  class Section;

  /** Declare section "Emission". */
  void declare(Section &root, EmissionSection &emission);
} // namespace apps
