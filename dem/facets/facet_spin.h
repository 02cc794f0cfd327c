#pragma once

#include "dem/facets/surface.h"

#include <Eigen/Core>

#include <array>

namespace dem
{
  /**
   * How the corners of a facet turn together, and forces on them that turn it (doc/theory/surface-coupling.md, 5).
   *
   * The spin is that of the rigid body that fits the corners' motion best, w = J^-1 sum y_i x v_i with y_i from their mean and
   * J = sum |y_i|^2 1 - y_i y_i^T. A couple c becomes the smallest forces that are one, sum g_i = 0 and sum x_i x g_i = c:
   * g_i = (J^-1 c) x y_i. That is the transpose of the first: sum g_i.v_i = c.w. Of a segment all of it is about z.
   */
  class FacetSpin
  {
  public:
    /** Of a facet where it is, or where it was before a part of its last step. @param back 0: now; 1: before the step */
    FacetSpin(const Surface &surface, std::size_t facet, double back = 0);
    /** Of a facet with its vertices at the places given. */
    FacetSpin(const FacetMesh &mesh, const std::vector<Eigen::Vector3d> &place, std::size_t facet);

    /** Of motions (or velocities) of the corners: with places of the middle of the step, of a rigid motion 2 tan(angle/2) times its axis. */
    Eigen::Vector3d turn(const std::array<Eigen::Vector3d, 3> &moved) const;
    /** On the corners [N]. @param couple [N m] */
    std::array<Eigen::Vector3d, 3> forces(const Eigen::Vector3d &couple) const;
    /** Bound of the row sum of a corner, in the stiffness matrix of a spring that turns the facet [N/m]. @param turning its stiffness [N m] */
    double stiffness(std::size_t corner, double turning) const;

  private:
    void measure(); ///< arms hold places

    std::size_t                    corners;
    std::array<Eigen::Vector3d, 3> arm;     ///< y_i [m]
    Eigen::Matrix3d                inverse; ///< J^-1 [1/m^2]
  };
} // namespace dem
