#pragma once

#include "apps/models/output.h"

namespace apps
{
  class Section;

  void declare(Section &root, OutputSection &output);
} // namespace apps
