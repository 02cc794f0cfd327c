#pragma once

#include "dem/peridynamics/boundary.h"

#include <Eigen/Core>

#include <vector>

namespace dem::peridynamics
{
  /** How the traction of a boundary point is shared out over the nodes within its horizon. */
  enum class TractionWeight
  {
    paper,     ///< delta - r, or delta^2 - r^2 of the general model: Yu et al. (2023), (23)-(26)
    consistent ///< (delta^D - r^D) / r^(D-1), or with D + 1: what the bonds lack that the boundary cut off
  };

  /** Where a traction acts on nodes. */
  enum class TractionForm
  {
    transfer, ///< through the transfer tensors of its points
    layer     ///< a body force in the outermost layer of nodes
  };

  /**
   * Transfer tensors G(x, x''') of boundary points: the force density at x is the sum of G p A over the points (doc/theory/peridynamics.md, 2).
   *
   * Volumes in G and in what is induced are the same, so that the sum of forces is the sum of p A, and that of moments about deformed
   * places the sum of y''' x p A, to rounding.
   */
  class Transfer
  {
  public:
    Transfer(const Grid                &grid,
             double                     horizon,
             BondModel                  model,
             std::vector<BoundaryPoint> points,
             TractionWeight             weight,
             TractionForm               form);

    const std::vector<BoundaryPoint> &points() const { return point; }

    /**
     * Add the forces [N] of tractions [Pa], one per point.
     * @param u displacements, by which directions are those of the deformed body; nullptr: of the body at rest
     */
    void add(const std::vector<Eigen::Vector3d> &traction, const Field *u, Field &forces) const;

    /** Place of a point: the displacement of the outer nodes goes on linearly to it. */
    Eigen::Vector3d place_of(const BoundaryPoint &p, const Field *u) const;

    /** Points whose nodes cannot carry a traction in every direction, because they lie on a line or there is one alone. */
    std::size_t singular() const { return singular_points; }
    /** Largest ratio of the eigenvalues of P's integral over the points that can; 2.5 to 3.2 at edges and corners of a plate. */
    double condition() const { return worst; }

  private:
    /** A node within the horizon of a point. */
    struct Share
    {
      std::size_t node;
      double      weight; ///< alpha times the node's volume
      bool        itself; ///< the node is at the point: its share has no direction
    };

    Eigen::Matrix3d product(const Share &share, const Eigen::Vector3d &from, const Field *u) const;
    void            spread(std::size_t p, const Eigen::Vector3d &force, const Field *u, Field &forces) const;

    Grid                       of; ///< a copy: what it is made for may move
    TractionForm               form;
    std::vector<BoundaryPoint> point;
    std::vector<std::size_t>   begin;
    std::vector<Share>         share;
    std::size_t                singular_points = 0;
    double                     worst           = 0;
  };

  /** Boundary weight of nodes at a distance r below the horizon. @param dimension of the body */
  double boundary_weight(TractionWeight weight, BondModel model, int dimension, double r, double horizon);
} // namespace dem::peridynamics
