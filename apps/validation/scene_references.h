#pragma once

#include "base/comparison.h"

#include <vector>

namespace apps
{
  /** Whole scenes, as they are shipped, beside closed forms; run in memory. */
  const std::vector<base::Reference> &scene_references();
} // namespace apps
