#pragma once

#include "apps/models/mix.h"

namespace apps
{
  class Section;

  /** Sub-section "Mix". @param specimen section */
  void declare(Section &specimen, MixSection &mix);
} // namespace apps
