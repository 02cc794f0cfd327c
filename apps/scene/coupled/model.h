#pragma once

#include "apps/runs/coupled/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, CoupledModel &model);
} // namespace apps
