#pragma once

#include "fem/solid/solid.h"

namespace fem
{
  /// A largest value of a field, and where.
  struct Extreme
  {
    double                value = 0;
    std::array<double, 3> place = {}; ///< undeformed [m]
  };

  /// What is largest in a solid: stresses at its integration points, displacements at the corners of its elements.
  struct SolidExtremes
  {
    Extreme tension;      ///< largest principal stress [Pa]
    Extreme compression;  ///< least one [Pa]
    Extreme mises;        ///< largest equivalent stress of von Mises [Pa]
    Extreme displacement; ///< length [m]

    /**
     * By how much the stress of the element of the largest equivalent stress leaves the mean of the elements of its material that meet at
     * its corners, at the worst of them, as equivalent stress over the largest one. A smooth stress on a fine mesh has little of it
     * (doc/theory/solid.md, 4; Zienkiewicz and Zhu, 1987: the averaged stress is the better one, and the difference an estimate of the error).
     * Of linear solids only: what softens has jumps of its own.
     */
    double disagreement = 0;
  };

  /// All ranks together; the same on each.
  template <int dim>
  SolidExtremes extremes_of(Solid<dim> &solid, const Vector &displacement);

  /// Equivalent stress of von Mises.
  double mises(const base::Voigt &stress);
}
