#pragma once

#include "apps/models/precice.h"

namespace apps
{
  class Section;

  /** Section "preCICE". @param vertices entry that names them, "Boundary" or "Group" @param meaning of it */
  void declare(Section &root, PreciceSection &precice, const char *vertices, const char *meaning);
} // namespace apps
