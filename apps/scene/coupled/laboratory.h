#pragma once

#include "apps/runs/coupled/laboratory.h"

namespace apps
{
  class Section;

  void declare(Section &root, LaboratorySection &laboratory);
} // namespace apps
