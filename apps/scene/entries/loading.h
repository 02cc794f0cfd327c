#pragma once

#include "apps/models/loading.h"

namespace apps
{
  class Section;

  void declare(Section &root, UniaxialLoadingSection &uniaxial_loading);
} // namespace apps
