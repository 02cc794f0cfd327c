#pragma once

#include "fem/solid/solid.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <vector>

namespace fem
{
  /**
   * A linear solid condensed to some of its displacements, those kept; all others are in equilibrium (Guyan 1965; exact in statics;
   * doc/theory/static-handshake.md, 1). Its loads and prescribed displacements grow with a factor p: those at time p.
   */
  template <int dim>
  class CondensedSolid
  {
  public:
    using Dof = dealii::types::global_dof_index;

    /**
     * @param solid must outlive this; its supports need not hold it where what is kept does
     * @param dead forces on all displacements that do not grow with p, of which a part l acts; null: none
     * @throws base::InputError if the solid is not linear, its loads are not in proportion to time, or a part of it is held by nothing
     */
    CondensedSolid(Solid<dim> &solid, const std::vector<Dof> &kept, const Vector *dead = nullptr);

    /// Of the kept displacements x [N/m]; zero where they are prescribed.
    const Eigen::MatrixXd &stiffness() const { return of_kept; }
    /// Force that keeps x at zero, per unit of the factor [N].
    const Eigen::VectorXd &by_factor() const { return on_kept; }
    /// Second derivative of the energy less the loads' work with the factor, x at zero [J].
    double of_factor() const { return of_loads; }
    /// Forces applied do the work p (w x + p w_0): w [N] and w_0 [J].
    const Eigen::VectorXd &load_work() const { return work_on_kept; }
    double                 own_load_work() const { return work_on_itself; }

    /// What the dead forces are to the kept displacements: their energy less their work is - l (f x + p by_factor) - 1/2 l^2 by_itself.
    struct DeadForces
    {
      Eigen::VectorXd on_kept;       ///< f [N]
      double          by_factor = 0; ///< [J]
      double          by_itself = 0; ///< [J]
      double          on_loads  = 0; ///< work of the forces applied at p = 1 on what they do, x at zero [J]
    };
    const DeadForces &dead() const { return of_dead; }

    /// Of the whole solid [m]. @param part of the dead forces that acts
    Vector displacement(const Eigen::VectorXd &x, double factor, double part = 0) const;

    /// Whether a displacement is prescribed.
    bool is_prescribed(const Dof dof) const { return solid.constraints().is_constrained(dof); }

  private:
    using Sparse = Eigen::SparseMatrix<double>;

    void   sort_displacements(const std::vector<Dof> &kept);
    void   assemble();
    Vector in_proportion(const std::function<void(double, Vector &)> &of_time, const char *what) const;
    void   condense();
    void   condense_dead(const Vector &force);

    Solid<dim>      &solid;
    Vector           prescribed, loads; ///< at a factor of one
    std::vector<int> place;             ///< of each displacement, among those kept (>= 0) or inside (-1 - place)
    std::vector<Dof> kept, inside;
    Sparse           inner, between; ///< stiffness of those inside, and of inside against kept
    Eigen::MatrixXd  of_kept;
    Eigen::VectorXd  on_kept, on_inside, work_on_kept, load_inside, dead_inside;
    DeadForces       of_dead;
    double           of_loads = 0, work_on_itself = 0;

    Eigen::SimplicialLDLT<Sparse> factor;
  };
}
