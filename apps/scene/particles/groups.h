#pragma once

#include "apps/runs/particles/groups.h"

namespace apps
{
  class Section;

  void declare(Section &section, GroupSection &group);
  void declare(Section &root, GroupsSection &groups);
} // namespace apps
