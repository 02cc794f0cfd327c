#pragma once

#include "base/voigt.h"

#include <deal.II/fe/fe_values.h>

#include <vector>

namespace fem
{
  /// Voigt components that a plane or solid model can fill.
  template <int dim>
  inline constexpr int n_rows = dim == 2 ? 4 : 6;

  template <int dim>
  constexpr int voigt_row(const int row)
  {
    constexpr int plane[4] = {0, 1, 2, 5};
    return dim == 2 ? plane[row] : row;
  }

  /**
   * Strain-displacement matrices of one element, and what follows from them (doc/theory/solid.md, 1).
   *
   * Small strain: eps = B u. Total Lagrangian: E = (F^T F - 1)/2, with B = dE/du and the initial-stress stiffness
   * (Belytschko, Liu and Moran 2000, chapter 4.9). Mean dilatation: the volumetric part of B is its average over
   * the element (Hughes 1980).
   */
  template <int dim>
  class ElementKernel
  {
  public:
    ElementKernel(const dealii::FiniteElement<dim> &fe, unsigned int n_points, bool large, bool mean);

    /// Takes the shape gradients of the element at hand and its displacements.
    void reinit(const dealii::FEValues<dim> &values, const Eigen::VectorXd &displacement);

    /// Lets only a part of a point's volume count, until the next reinit().
    void share(const unsigned int point, const double part) { weights[point] *= part; }

    /// Strain at a point.
    base::Voigt strain(unsigned int point);

    /// Adds the force of a stress at the point whose strain was evaluated last.
    void add_force(const base::Voigt &stress, Eigen::VectorXd &force) const;

    /// Adds the stiffness at the point whose strain was evaluated last.
    void add_stiffness(const base::Voigt &stress, const base::Stiffness &tangent, Eigen::MatrixXd &stiffness);

  private:
    using BMatrix = Eigen::Matrix<double, n_rows<dim>, Eigen::Dynamic>;

    void linear_b(unsigned int point);
    void lagrangian_b(unsigned int point);

    const bool                          large, mean;
    const unsigned int                  n_dofs, n_points;
    std::vector<unsigned int>           component; // of each local degree of freedom
    std::vector<dealii::Tensor<1, dim>> gradients; // n_points x n_dofs
    std::vector<double>                 weights;
    std::vector<dealii::Tensor<1, dim>> mean_gradients;
    Eigen::VectorXd                     u;
    BMatrix                             b, db;
    dealii::Tensor<2, dim>              deformation;
    unsigned int                        current = 0;
  };
}
