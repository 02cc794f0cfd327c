#pragma once

#include "apps/models/region.h"

namespace apps
{
  class Section;

  /** @param requested whether there is a region at all, @param words the same in words; both may be left out: always. */
  void
  declare(Section &section, Region &region, const std::function<bool()> &requested = {}, const std::string &words = "");
} // namespace apps
