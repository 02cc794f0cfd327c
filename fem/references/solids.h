#pragma once

#include "base/comparison.h"

/** Solids of finite elements beside closed forms and values of the literature. */
namespace fem::references
{
  void cook_membrane(base::Comparisons &rows);
  void cantilever_of_weight(base::Comparisons &rows);
  void hole_in_plate(base::Comparisons &rows);
  void stretched_cube(base::Comparisons &rows);
  void thick_cylinder(base::Comparisons &rows);
} // namespace fem::references
