#include "fem/solid/element_kernel.h"

namespace fem
{
  using namespace dealii;

  template <int dim>
  ElementKernel<dim>::ElementKernel(const FiniteElement<dim> &fe,
                                    const unsigned int        n_points_,
                                    const bool                large_,
                                    const bool                mean_)
    : large(large_)
    , mean(mean_)
    , n_dofs(fe.n_dofs_per_cell())
    , n_points(n_points_)
    , component(n_dofs)
    , gradients(n_points * n_dofs)
    , weights(n_points)
    , mean_gradients(n_dofs)
    , b(n_rows<dim>, n_dofs)
    , db(n_rows<dim>, n_dofs)
  {
    for (unsigned int i = 0; i < n_dofs; ++i)
      component[i] = fe.system_to_component_index(i).first;
    b.setZero();
  }

  template <int dim>
  void ElementKernel<dim>::reinit(const FEValues<dim> &values, const Eigen::VectorXd &displacement)
  {
    u = displacement;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        weights[q] = values.JxW(q);
        for (unsigned int i = 0; i < n_dofs; ++i)
          gradients[q * n_dofs + i] = values.shape_grad(i, q);
      }
    if (!mean)
      return;
    double volume = 0;
    for (auto &g : mean_gradients)
      g = 0;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        volume += weights[q];
        for (unsigned int i = 0; i < n_dofs; ++i)
          mean_gradients[i] += weights[q] * gradients[q * n_dofs + i];
      }
    for (auto &g : mean_gradients)
      g /= volume;
  }

  template <int dim>
  base::Voigt ElementKernel<dim>::strain(const unsigned int point)
  {
    current = point;
    if (!large)
      {
        linear_b(point);
        const Eigen::Matrix<double, n_rows<dim>, 1> rows = b * u;
        base::Voigt                                 e    = base::Voigt::Zero();
        for (int r = 0; r < n_rows<dim>; ++r)
          e[voigt_row<dim>(r)] = rows[r];
        return e;
      }
    lagrangian_b(point);
    Eigen::Matrix3d green = Eigen::Matrix3d::Zero();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          // (H + H^T + H^T H)/2 rather than (F^T F - 1)/2: no cancellation at small strain
          double quadratic = 0;
          for (int k = 0; k < dim; ++k)
            quadratic += (deformation[k][i] - (k == i)) * (deformation[k][j] - (k == j));
          green(i, j) = 0.5 * ((deformation[i][j] - (i == j)) + (deformation[j][i] - (i == j)) + quadratic);
        }
    return base::strain_voigt(green);
  }

  template <int dim>
  void ElementKernel<dim>::linear_b(const unsigned int point)
  {
    const Tensor<1, dim> *g = &gradients[point * n_dofs];
    for (unsigned int i = 0; i < n_dofs; ++i)
      {
        const unsigned int c = component[i];
        if constexpr (dim == 2)
          {
            b.col(i) << (c == 0 ? g[i][0] : 0.0), (c == 1 ? g[i][1] : 0.0), 0.0, g[i][1 - c];
          }
        else
          {
            b.col(i) << (c == 0 ? g[i][0] : 0.0), (c == 1 ? g[i][1] : 0.0), (c == 2 ? g[i][2] : 0.0),
              (c == 1 ? g[i][2] :
               c == 2 ? g[i][1] :
                        0.0),
              (c == 0 ? g[i][2] :
               c == 2 ? g[i][0] :
                        0.0),
              (c == 0 ? g[i][1] :
               c == 1 ? g[i][0] :
                        0.0);
          }
        if (mean)
          b.template block<3, 1>(0, i).array() += (mean_gradients[i][c] - g[i][c]) / 3;
      }
  }

  template <int dim>
  void ElementKernel<dim>::lagrangian_b(const unsigned int point)
  {
    const Tensor<1, dim> *g = &gradients[point * n_dofs];
    deformation             = 0;
    for (int d = 0; d < dim; ++d)
      deformation[d][d] = 1;
    for (unsigned int i = 0; i < n_dofs; ++i)
      deformation[component[i]] += u[i] * g[i];
    for (unsigned int i = 0; i < n_dofs; ++i)
      {
        const Tensor<1, dim> &f = deformation[component[i]];
        if constexpr (dim == 2)
          b.col(i) << f[0] * g[i][0], f[1] * g[i][1], 0.0, f[0] * g[i][1] + f[1] * g[i][0];
        else
          b.col(i) << f[0] * g[i][0], f[1] * g[i][1], f[2] * g[i][2], f[1] * g[i][2] + f[2] * g[i][1],
            f[0] * g[i][2] + f[2] * g[i][0], f[0] * g[i][1] + f[1] * g[i][0];
      }
  }

  template <int dim>
  void ElementKernel<dim>::add_force(const base::Voigt &stress, Eigen::VectorXd &force) const
  {
    Eigen::Matrix<double, n_rows<dim>, 1> s;
    for (int r = 0; r < n_rows<dim>; ++r)
      s[r] = stress[voigt_row<dim>(r)];
    force.noalias() += weights[current] * (b.transpose() * s);
  }

  template <int dim>
  void ElementKernel<dim>::add_stiffness(const base::Voigt     &stress,
                                         const base::Stiffness &tangent,
                                         Eigen::MatrixXd       &stiffness)
  {
    Eigen::Matrix<double, n_rows<dim>, n_rows<dim>> d;
    for (int r = 0; r < n_rows<dim>; ++r)
      for (int c = 0; c < n_rows<dim>; ++c)
        d(r, c) = weights[current] * tangent(voigt_row<dim>(r), voigt_row<dim>(c));
    db.noalias() = d * b;
    stiffness.noalias() += b.transpose() * db;
    if (!large)
      return;
    const Tensor<1, dim> *g = &gradients[current * n_dofs];
    const Eigen::Matrix3d s = base::stress_tensor(stress);
    for (unsigned int i = 0; i < n_dofs; ++i)
      {
        Tensor<1, dim> sg;
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            sg[k] += s(k, l) * g[i][l];
        for (unsigned int j = 0; j < n_dofs; ++j)
          if (component[i] == component[j])
            stiffness(i, j) += weights[current] * (sg * g[j]);
      }
  }

  template class ElementKernel<2>;
  template class ElementKernel<3>;
}
