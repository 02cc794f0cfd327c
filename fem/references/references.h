#pragma once

#include "base/comparison.h"

#include <vector>

namespace fem
{
  /** What the materials of the continuum are compared with; tests run each by its subject. */
  const std::vector<base::Reference> &all_references();
} // namespace fem
