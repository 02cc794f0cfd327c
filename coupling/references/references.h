#pragma once

#include "base/comparison.h"

#include <vector>

namespace coupling
{
  /** What transfers of particle states are compared with; tests run each by its subject. */
  const std::vector<base::Reference> &all_references();
} // namespace coupling
