#pragma once

#include "apps/runs/homogenisation/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, HomogenisationModel &model);
} // namespace apps
