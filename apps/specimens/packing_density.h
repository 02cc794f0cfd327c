#pragma once

#include "dem/model/packing.h"

#include <Eigen/Core>

#include <string>

namespace apps
{
  /** How densely particles are packed: solid over bulk volume (area of discs), overlaps counted twice [-]. */
  struct PackingDensity
  {
    double inside; ///< away from the surface; where nothing is, that of the whole
    double whole;  ///< of the box that is said

    /** Faces cut out of a larger packing are sparse, and count for much where a specimen is small. */
    bool has_sparse_faces() const;
  };

  PackingDensity density_in(const dem::Packing &packing, const Eigen::Vector3d &box, int dimension);

  /**
   * How much of the links a box has in its volume, over what its inside has: sums of length times area, to which the closed form of the
   * moduli is proportional (doc/theory/homogenisation.md, 2), so about what is left of the stiffness of its inside.
   *
   * @param ratio of the distance to the sum of radii, and @param gap [m] further, up to which particles are linked
   */
  double linked_part(const dem::Packing &packing, const Eigen::Vector3d &box, int dimension, double ratio, double gap);

  /** The line of a forecast: of the periodic cell, or inside and of the box around all particles; "" for rigid bodies, whose pebbles overlap. */
  std::string density_line(const dem::Packing &packing, int dimension);
} // namespace apps
