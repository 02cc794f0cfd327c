#pragma once

#include "coupling/volume/node_map.h"

#include <Eigen/Geometry>

#include <vector>

/** How elements turn where something is tied to them (doc/theory/volume-coupling.md, 5). */
namespace coupling
{
  /**
   * The rotation R of a deformation gradient F = R U, and how that goes with velocities: spin = rate * sum_J (R grad N_J) x v_J, and, by
   * the transpose, a couple c is the forces (rate c) x (R grad N_J) on the nodes, which have no sum and the moment c. As made: what small
   * displacements have, half the curl.
   */
  struct Turn
  {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d rate     = 0.5 * Eigen::Matrix3d::Identity(); ///< R (tr U 1 - U)^-1 R^T, symmetric

    /** Force on a node, by the undeformed gradient of its weight [1/m]. */
    Eigen::Vector3d force_of(const Eigen::Vector3d &couple, const Eigen::Vector3d &gradient) const
    {
      return (rate * couple).cross(Eigen::Vector3d(rotation * gradient));
    }
  };

  /** @pre the determinant is positive */
  Turn turn_of(const Eigen::Matrix3d &deformation_gradient);

  /** Rotation vector from one rotation to another, the shortest. */
  Eigen::Vector3d rotation_between(const Eigen::Matrix3d &before, const Eigen::Matrix3d &now);

  /** Sums over the nodes of each row: its place [m], and the deformation gradient there. */
  struct PlacesNow
  {
    std::vector<Eigen::Vector3d> place;
    std::vector<Turn>            turn;
  };

  /** @param nodes where they are now [m] @param dimension in the plane nothing happens along the third axis */
  template <typename Entries>
  PlacesNow places_now(const Entries &entries, const std::size_t rows, const CarrierRows &nodes, const int dimension)
  {
    PlacesNow       found{std::vector<Eigen::Vector3d>(rows, Eigen::Vector3d::Zero()), std::vector<Turn>(rows)};
    Eigen::Matrix3d none = Eigen::Matrix3d::Zero();
    none(2, 2)           = dimension == 2 ? 1 : 0;
    std::vector<Eigen::Matrix3d> gradient(rows, none);
    for (const auto &e : entries)
      {
        const Eigen::Vector3d at = nodes.row(static_cast<Eigen::Index>(e.node));
        found.place[e.row] += e.weight * at;
        gradient[e.row] += at * e.gradient.transpose();
      }
    for (std::size_t row = 0; row < rows; ++row)
      found.turn[row] = turn_of(gradient[row]);
    return found;
  }
} // namespace coupling
