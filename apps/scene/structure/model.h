#pragma once

#include "apps/runs/structure/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, PathSection &path);
  void declare(Section &root, StructureModel &model);
} // namespace apps
