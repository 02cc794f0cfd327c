#pragma once

#include "base/comparison.h"

#include <vector>

namespace statistics
{
  /** What probabilities and their limits are compared with; tests run each by its subject. */
  const std::vector<base::Reference> &all_references();
} // namespace statistics
