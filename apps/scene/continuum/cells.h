#pragma once

#include "apps/runs/continuum/cells.h"

namespace apps
{
  class Section;

  /** Everything but the numbers, which declare themselves: packing and material of the particles, what becomes of cells that localise. */
  void declare(Section &block, CellsModel &cells);
} // namespace apps
