#pragma once

#include "dem/core/uniform_random.h"
#include "dem/model/packing.h"

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /** A convex polygon, its corners counter-clockwise [m]. */
  struct Polygon
  {
    std::vector<Eigen::Vector2d> corners;

    double          area() const;
    Eigen::Vector2d centroid() const;
    /** Second moment about the centroid over the area, of x and of y together [m^2]. */
    double polar_moment() const;
    /** Inside or on an edge. */
    bool holds(const Eigen::Vector2d &place) const;
    /** How deep a place lies inside: the distance to the nearest edge, below 0 outside [m]. */
    double depth(const Eigen::Vector2d &place) const;
    /** Multiply distances from the centroid. */
    void scale(double factor);
    void move(const Eigen::Vector2d &by);
  };

  /** @param corners in their order, either way round [m] @throws base::InputError where they bound no convex polygon, naming one (from 1) */
  Polygon convex_polygon(const std::vector<Eigen::Vector2d> &corners);

  /** Gap along the axis that parts two convex polygons best, among the normals of their edges; at most their distance, below 0: they overlap [m]. */
  double separation(const Polygon &one, const Polygon &other);

  /** As a rigid body of a packing: area, centroid and inertia of the polygon. */
  PackedBody body_of(const Polygon &polygon);

  /**
   * A random polygon on a circle around the origin, scaled about its centroid until it has the circle's area (doc/theory/genesis.md, 6). It
   * has round(fewest + u (most - fewest)) corners; drawn again until angles between corners are at least a quarter of even ones and below
   * pi, so that the centre lies inside.
   */
  Polygon random_polygon(double radius, int fewest, int most, UniformRandom &random);
} // namespace dem
