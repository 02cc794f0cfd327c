#pragma once

#include "apps/scene/section.h"

#include <string>

namespace apps
{
  /** "Material/CPM/Cohesion" of a scene; nullptr: not there. */
  const Entry *entry_at(const Section &root, const std::string &path);
} // namespace apps
