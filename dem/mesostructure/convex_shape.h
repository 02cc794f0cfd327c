#pragma once

#include "dem/core/uniform_random.h"

#include <Eigen/Core>

#include <memory>

namespace dem
{
  /** A convex shape about the origin with the volume of a sphere of radius 1, from which aggregates of all sizes are scaled. */
  class ConvexShape
  {
  public:
    virtual ~ConvexShape() = default;
    /** Its point that lies furthest in a direction (the support function). @param direction of any length above 0 */
    virtual Eigen::Vector3d furthest(const Eigen::Vector3d &direction) const = 0;
    /** How deep a place lies inside: the distance to its surface; negative outside (at most the distance there; doc/theory/mesostructure.md, 4). */
    virtual double depth(const Eigen::Vector3d &place) const = 0;
    virtual double reach() const                             = 0; ///< of its surface from the origin
    virtual double inner_reach() const                       = 0; ///< of a ball about the origin that lies inside
    virtual bool   is_sphere() const { return false; }
  };

  std::shared_ptr<const ConvexShape> unit_sphere();
  /** @param elongation middle over longest axis @param flatness shortest over middle, both in (0, 1] @throws base::InputError */
  std::shared_ptr<const ConvexShape> ellipsoid(double elongation, double flatness);
  /**
   * A random polyhedron: hull of `corners` places on a sphere, no two of which are nearer than half of what an even spread would have, its axes
   * then scaled as those of ellipsoid(). @param corners from 6 to 24 @throws base::InputError
   */
  std::shared_ptr<const ConvexShape>
  random_polyhedron(int corners, double elongation, double flatness, UniformRandom &random);

  /** Evenly distributed over all rotations (Shoemake, 1992, Graphics Gems III, 124). */
  Eigen::Matrix3d random_rotation(UniformRandom &random);
} // namespace dem
