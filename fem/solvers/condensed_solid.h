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
     * @throws base::InputError if the solid is not linear, its loads are not in proportion to time, or a part of it is held by nothing
     */
    CondensedSolid(Solid<dim> &solid, const std::vector<Dof> &kept);

    /// Of the kept displacements x [N/m]; zero where they are prescribed.
    const Eigen::MatrixXd &stiffness() const { return of_kept; }
    /// Force that keeps x at zero, per unit of the factor [N].
    const Eigen::VectorXd &by_factor() const { return on_kept; }
    /// Second derivative of the energy less the loads' work with the factor, x at zero [J].
    double of_factor() const { return of_loads; }
    /// Forces applied do the work p (w x + p w_0): w [N] and w_0 [J].
    const Eigen::VectorXd &load_work() const { return work_on_kept; }
    double                 own_load_work() const { return work_on_itself; }

    /// Of the whole solid [m].
    Vector displacement(const Eigen::VectorXd &x, double factor) const;

    /// Whether a displacement is prescribed.
    bool is_prescribed(const Dof dof) const { return solid.constraints().is_constrained(dof); }

  private:
    using Sparse = Eigen::SparseMatrix<double>;

    void   sort_displacements(const std::vector<Dof> &kept);
    void   assemble();
    Vector in_proportion(const std::function<void(double, Vector &)> &of_time, const char *what) const;
    void   condense();

    Solid<dim>      &solid;
    Vector           prescribed, loads; ///< at a factor of one
    std::vector<int> place;             ///< of each displacement, among those kept (>= 0) or inside (-1 - place)
    std::vector<Dof> kept, inside;
    Sparse           inner, between; ///< stiffness of those inside, and of inside against kept
    Eigen::MatrixXd  of_kept;
    Eigen::VectorXd  on_kept, on_inside, work_on_kept, load_inside;
    double           of_loads = 0, work_on_itself = 0;

    Eigen::SimplicialLDLT<Sparse> factor;
  };
}
