#pragma once

#include "apps/runs/peridynamic_core/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, PeridynamicCoreModel &model);
} // namespace apps
