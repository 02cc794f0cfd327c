#pragma once

#include "apps/models/gravity.h"

namespace apps
{
  class Section;

  /** @param meaning of the section */
  void declare(Section &root, GravitySection &gravity, const char *meaning = "Weight of the particles");

  /** The same where the weight is put on before anything else acts, and stays. @param meaning of the section */
  void declare_dead_weight(Section &root, GravitySection &gravity, const char *meaning);
} // namespace apps
