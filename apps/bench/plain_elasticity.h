#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

namespace apps
{
  /**
   * Elasticity as a first deal.II program does it: the yardstick of the bench.
   *
   * Trilinear hexahedra in the unit cube, held at x = 0; FEValues in every element, a serial sparse matrix, conjugate gradients with
   * SSOR.
   */
  class PlainElasticity
  {
  public:
    explicit PlainElasticity(unsigned int divisions);

    std::size_t unknowns() const { return dofs.n_dofs(); }

    void assemble();
    void multiply(); ///< result = K x

    /** @return iterations for the load of a pull at x = 1, to 1e-10. */
    unsigned int solve();

    /** One step of central differences: internal forces element by element, then velocity and displacement. */
    void step(double length);

  private:
    dealii::Triangulation<3>          mesh;
    dealii::FESystem<3>               element;
    dealii::DoFHandler<3>             dofs;
    dealii::AffineConstraints<double> held;
    dealii::SparsityPattern           pattern;
    dealii::SparseMatrix<double>      matrix;
    dealii::Vector<double>            load, x, result, velocity, displacement, force, mass;
  };
} // namespace apps
