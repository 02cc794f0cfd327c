#pragma once

#include "fem/solid/solid.h"

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Eigen/SparseCholesky>

#include <memory>

namespace fem
{
  /**
   * Answers the coarsest level of a multigrid method: small ones are factorised, the same on every rank; large ones get as many
   * Chebyshev steps on algebraic multigrid as bring the error to a tenth, a fixed linear operation.
   */
  template <int dim>
  class CoarsestLevel
  {
  public:
    using LevelVector = dealii::LinearAlgebra::distributed::Vector<float>;

    /// Unknowns up to which it is factorised: a fraction of a second, and no rank waits for another.
    static constexpr unsigned int direct_limit = 6000;

    /// @param held displacements of level 0 that are prescribed.
    CoarsestLevel(const Solid<dim>                                                 &solid,
                  const dealii::DoFHandler<dim>                                    &dofs,
                  const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout,
                  const dealii::AffineConstraints<double>                          &held);

    void solve(LevelVector &solution, const LevelVector &right_side) const;

    std::string description() const;

  private:
    using Smoother = dealii::PreconditionChebyshev<Matrix, Vector, dealii::TrilinosWrappers::PreconditionAMG>;

    /// visit(local stiffness, global numbers) for every locally owned element of the level.
    template <typename Visit>
    void visit_elements(const Visit &visit) const;

    void factorise();
    void set_up_multigrid();

    const Solid<dim>                                          &solid;
    const dealii::DoFHandler<dim>                             &dofs;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> layout;
    const dealii::AffineConstraints<double>                   &held;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>         factors;
    Matrix                                                     matrix;
    Smoother                                                   cycles;
    mutable Vector                                             x, b;
  };

  /// Material of an element of any level: that of its first descendant, which the same rank owns.
  template <int dim>
  const MaterialPoints &material_of(const Solid<dim> &solid, typename dealii::Triangulation<dim>::cell_iterator cell)
  {
    while (cell->has_children())
      cell = cell->child(0);
    return solid.material(cell->material_id());
  }
}
