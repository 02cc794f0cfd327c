#pragma once

#include "apps/runs/coupled/bond.h"

namespace apps
{
  class Section;

  void declare(Section &coupling, BondSection &bond);
} // namespace apps
