#pragma once

#include "apps/models/gravity.h"

namespace apps
{
  class Section;

  /** @param meaning of the section */
  void declare(Section &root, GravitySection &gravity, const char *meaning = "Weight of the particles");
} // namespace apps
