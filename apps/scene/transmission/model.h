#pragma once

#include "apps/runs/transmission/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, TransmissionModel &model);
} // namespace apps
