#pragma once

#include "coupling/volume/parameters.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <memory>
#include <vector>

namespace coupling
{
  /** Velocities (or inverse masses) of carriers, a row for each, a column for each axis. */
  using CarrierRows = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  using WeightRows  = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  /** Impulses that a correction gives to both sides, as changes of velocities [m/s]. */
  struct CarrierChanges
  {
    CarrierRows particles, nodes;
  };

  /**
   * Lagrange multipliers that keep particles and the nodes of a solid together where both fill the same space: after each explicit step,
   * the smallest impulses (in the norm of the masses) with which the velocities obey the constraints (doc/theory/volume-coupling.md, 3; Xiao
   * and Belytschko 2004; Ben Dhia 1998).
   */
  class Multipliers
  {
  public:
    /**
     * @param weights of the nodes (columns) at the particles (rows) @param particles, nodes their inverse masses, zero where motion is
     * prescribed [1/kg] @param lumped rows of the system are summed up on the diagonal: cheap, dissipative, and not exact
     */
    Multipliers(const WeightRows  &weights,
                const CarrierRows &particles,
                const CarrierRows &nodes,
                Compatibility      compatibility,
                bool               lumped);

    /** What the velocities [m/s] lack. */
    CarrierChanges changes(const CarrierRows &particles, const CarrierRows &nodes) const;

    Eigen::Index nodes() const { return rows_on_nodes.cols(); }

  private:
    using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
    struct Axis
    {
      Eigen::VectorXd             particles, nodes; ///< inverse masses [1/kg]
      Eigen::SparseMatrix<double> system;           ///< where its factor is not that of the very system
      std::shared_ptr<Factor>     factor;           ///< none: lumped
      Eigen::VectorXd             lumped;           ///< inverse of the summed rows
    };

    /** The same factor for axes along which the same can move. */
    void            factor(const Eigen::SparseMatrix<double> &system, Axis &axis);
    Eigen::VectorXd solve(const Axis &axis, const Eigen::VectorXd &right) const;

    WeightRows          rows_on_particles, rows_on_nodes; ///< constraint = first * particles - second * nodes
    WeightRows          of_particles, of_nodes;           ///< their transposes
    std::array<Axis, 3> axes;
  };
} // namespace coupling
