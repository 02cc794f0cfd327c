#pragma once

#include "apps/runs/coupled/couplings.h"

namespace apps
{
  class Section;

  void declare(Section &section, CouplingSection &coupling);
  void declare(Section &root, CouplingsSection &couplings);
} // namespace apps
