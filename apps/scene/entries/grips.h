#pragma once

#include "apps/models/grips.h"

namespace apps
{
  class Section;

  /** @param gripped whether there are grips at all, @param words the same in words; both may be left out: always. */
  void declare(Section                     &loading,
               GripEntries                 &grip_entries,
               const std::function<bool()> &gripped = {},
               const std::string           &words   = "");
} // namespace apps
