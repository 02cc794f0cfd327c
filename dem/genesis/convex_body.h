#pragma once

#include "dem/genesis/polygon.h"
#include "dem/genesis/polyhedron.h"
#include "dem/packing/lattice.h"

#include <Eigen/Core>

#include <variant>
#include <vector>

namespace dem
{
  /** A convex polygon in the plane, or polyhedron in space, that pebbles are to stand for (doc/theory/clumps.md, 3). */
  class ConvexBody
  {
  public:
    /** @param corners [m]; of a polygon in their order @param dimension 2: z is ignored @throws base::InputError as convex_polygon() and Polyhedron */
    ConvexBody(const std::vector<Eigen::Vector3d> &corners, int dimension);

    /** How deep a place lies inside, below 0 outside [m]. */
    double depth(const Eigen::Vector3d &place) const;
    bool   holds(const Eigen::Vector3d &place) const { return depth(place) >= 0; }
    /** Its volume (area), centre of mass and inertia. */
    const PackedBody &properties() const { return as_body; }
    int               dimension() const { return std::holds_alternative<Polygon>(shape) ? 2 : 3; }
    double            reach() const { return largest_arm; } ///< of its corners from the centre of mass [m]

  private:
    std::variant<Polygon, Polyhedron> shape;
    PackedBody                        as_body;
    double                            largest_arm = 0;
  };

  /** How pebbles lie that fill a body. */
  enum class Filling
  {
    close, ///< as densely as can be: face-centred cubic, in the plane hexagonal
    cubic  ///< a simple cubic grid, in the plane a square one
  };

  /**
   * Touching pebbles of one size that lie wholly inside a body, in a lattice along the axes, whose phase (a pebble or the middle between two
   * in the centre of mass, along each axis) is that which holds most. One rigid body with the mass and inertia of the shape.
   * @throws base::InputError where fewer than three pebbles find room, or more than ten million
   */
  Packing filled_with_pebbles(const ConvexBody &body, double radius, Filling filling);
} // namespace dem
