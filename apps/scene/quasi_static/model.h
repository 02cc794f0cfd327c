#pragma once

#include "apps/runs/quasi_static/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, QuasiStaticModel &model);
} // namespace apps
