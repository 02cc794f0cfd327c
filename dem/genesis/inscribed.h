#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dem
{
  /** What a sphere (in the plane a disc) may touch: another one, or a wall. */
  struct Obstacle
  {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [m]
    double          radius = 0;                       ///< [m]
    /** Of a wall: unit normal into the space, and n x of its points [m]; a sphere has none. */
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double          offset = 0;

    bool   is_wall() const { return !normal.isZero(0); }
    double distance(const Eigen::Vector3d &place) const;
    /** Away from it, unit. */
    Eigen::Vector3d direction(const Eigen::Vector3d &place) const;
  };

  struct InscribedSphere
  {
    Eigen::Vector3d centre;
    double          radius; ///< [m]
  };

  /**
   * The sphere nearest to a place that cannot grow: it touches one obstacle more than there are dimensions, on all sides of it, and
   * overlaps none (the circles of Apollonius; each subset of obstacles is tried).
   * @param dimension 2: all centres lie in one plane of constant z @param furthest from the place [m]
   * @return nothing where there is none so near
   */
  std::optional<InscribedSphere> inscribed_sphere(const std::vector<Obstacle> &obstacles,
                                                  int                          dimension,
                                                  const Eigen::Vector3d       &place,
                                                  double                       furthest);
} // namespace dem
