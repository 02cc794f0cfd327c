#pragma once

#include "apps/runs/sequential/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, SequentialModel &model);
} // namespace apps
