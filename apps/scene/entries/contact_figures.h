#pragma once

#include "apps/figures/contact_figures.h"

namespace apps
{
  class Section;

  void declare(Section &root, ReferencesSection &references);
} // namespace apps
