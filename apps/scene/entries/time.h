#pragma once

#include "apps/models/time.h"

namespace apps
{
  class Section;

  void declare(Section &root, TimeSection &time);
  /** For kinds of scene whose damping may change on the way: the formula as well. @pre declare() */
  void declare_by_time(Section &root, TimeSection &time);
} // namespace apps
