#pragma once

#include "base/comparison.h"

#include <vector>

namespace optimisation
{
  /** What searches are compared with; tests run each by its subject. */
  const std::vector<base::Reference> &all_references();
} // namespace optimisation
