#pragma once

#include "apps/runs/cell/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, CellModel &model);
} // namespace apps
