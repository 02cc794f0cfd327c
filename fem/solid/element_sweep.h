#pragma once

#include "fem/solid/element_kernel.h"
#include "fem/solid/solid.h"

#include <deal.II/lac/full_matrix.h>

#include <sstream>

namespace fem
{
  /// One element of a solid after the other: its displacements, what its points answer, and where that belongs.
  template <int dim>
  class ElementSweep
  {
  public:
    /// @param more of what `values` should know at the points
    explicit ElementSweep(const Solid<dim> &solid, dealii::UpdateFlags more = dealii::update_default);

    void reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell, const Vector &displacement);

    base::Voigt                  strain(const unsigned int point) { return kernel.strain(point); }
    const dealii::FEValues<dim> &at_points() const { return values; }

    /// Force and, where wanted, stiffness of the element at hand. @throws MaterialFailure naming the element
    void integrate(const typename Solid<dim>::ElementPoints &points, bool with_stiffness);

    /// Adds what was integrated to force, products and tangent, as far as these are wanted.
    void add_to(const Sweep &wanted);

  private:
    const Solid<dim>                                      &solid;
    dealii::FEValues<dim>                                  values;
    ElementKernel<dim>                                     kernel;
    typename dealii::DoFHandler<dim>::active_cell_iterator cell;
    std::vector<dealii::types::global_dof_index>           indices;
    Eigen::VectorXd                                        u, f, g;
    Eigen::MatrixXd                                        k;
    dealii::FullMatrix<double>                             local;
  };

  /// The failure of a point, with the element that it is in.
  template <typename Cell>
  MaterialFailure in_element(const Cell &cell, const MaterialFailure &problem)
  {
    std::ostringstream text;
    text << "element " << cell->id() << " at " << cell->center() << ": " << problem.what();
    return MaterialFailure(text.str());
  }
} // namespace fem
