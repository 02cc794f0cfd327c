#pragma once

#include "base/comparison.h"

namespace dem::references
{
  /** Constants of the infinite square grid of peridynamic bonds over those of the continuum (doc/theory/peridynamics.md). */
  void peridynamic_lattice(base::Comparisons &rows);
} // namespace dem::references
