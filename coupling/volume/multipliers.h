#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace coupling
{
  /** Velocities (or inverse masses) of carriers, a row for each, a column for each axis. */
  using CarrierRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
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
     * prescribed [1/kg] @param parts where it is the mean of the difference around each node that is made zero: how much each particle counts
     * in it [-]; empty where it is the difference at each particle @param lumped rows of the system are summed up on the diagonal: cheap, dissipative, and not exact
     */
    Multipliers(const WeightRows      &weights,
                const CarrierRows     &particles,
                const CarrierRows     &nodes,
                const Eigen::VectorXd &parts,
                bool                   lumped);

    /** What the velocities [m/s] lack. */
    CarrierChanges changes(const CarrierRows &particles, const CarrierRows &nodes) const;

    Eigen::Index nodes() const { return rows_on_nodes.cols(); }

  private:
    /** L D L^T of a system. */
    struct Factor
    {
      Factor() = default;
      explicit Factor(const Eigen::SparseMatrix<double> &system);
      void solve(const CarrierRows &right, CarrierRows &solution) const;

      bool                                                          valid = false;
      Eigen::SparseMatrix<double>                                   lower; ///< below the diagonal of ones
      Eigen::VectorXd                                               pivots;
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    };
    /** Axes along which the same can move. */
    struct Group
    {
      std::vector<int>            axes;
      Factor                      factor;
      Eigen::SparseMatrix<double> system; ///< where the factor is not that of the very system
      Eigen::VectorXd             lumped; ///< inverse of the summed rows; empty: there is a factor
      Eigen::VectorXd
        riding; ///< masses of particles that all follow the nodes: the factor is that of these [kg]; else empty
    };

    static void factor(Group &group, const Eigen::SparseMatrix<double> &system);
    /** Where every particle can follow. */
    void        factor_riding(Group &group, const Eigen::VectorXd &particles, const Eigen::VectorXd &nodes) const;
    CarrierRows solve(const Group &group, const CarrierRows &right) const;
    /** Along the axes of a group. @param lacking of each particle */
    void follow(const Group &group, const CarrierRows &lacking, CarrierChanges &change) const;

    WeightRows         rows_on_particles, rows_on_nodes; ///< constraint = first * particles - second * nodes
    WeightRows         of_particles, of_nodes;           ///< their transposes
    CarrierRows        inverse_particles, inverse_nodes; ///< masses [1/kg]
    std::vector<Group> groups;
  };
} // namespace coupling
