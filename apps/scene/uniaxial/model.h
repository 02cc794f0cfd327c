#pragma once

#include "apps/runs/uniaxial/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, UniaxialModel &model);
} // namespace apps
