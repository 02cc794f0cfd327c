#pragma once

#include "base/comparison.h"

#include <vector>

namespace dem
{
  /** What particles and bonds are compared with; tests run each by its subject. */
  const std::vector<base::Reference> &all_references();
} // namespace dem
