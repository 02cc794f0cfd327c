#pragma once

#include "base/comparison.h"

/** Values of damage-plastic concrete, published or from an independent program (doc/theory/damage-plastic-concrete.md, 6). */
namespace fem::references
{
  void yield_constants(base::Comparisons &rows);
  void yield_at_general_stress(base::Comparisons &rows);
  void damage_over_opening(base::Comparisons &rows);
  void uniaxial_tension(base::Comparisons &rows);
  void uniaxial_compression(base::Comparisons &rows);
  void confined_strain(base::Comparisons &rows);
  void non_proportional_path(base::Comparisons &rows);
  void published_compression(base::Comparisons &rows); ///< of material M2
} // namespace fem::references
