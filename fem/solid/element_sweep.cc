#include "fem/solid/element_sweep.h"

namespace fem
{
  using namespace dealii;

  template <int dim>
  ElementSweep<dim>::ElementSweep(const Solid<dim> &body, const UpdateFlags more)
    : solid(body)
    , values(body.mapping(),
             body.dofs().get_fe(),
             body.quadrature(),
             update_gradients | update_JxW_values | (body.options().share ? update_quadrature_points : update_default) |
               more)
    , kernel(body.dofs().get_fe(),
             body.quadrature().size(),
             body.options().large_displacement,
             body.options().mean_dilatation)
    , indices(body.dofs().get_fe().n_dofs_per_cell())
    , u(indices.size())
    , f(indices.size())
    , g(indices.size())
    , k(indices.size(), indices.size())
    , local(static_cast<unsigned int>(indices.size()), static_cast<unsigned int>(indices.size()))
  {
  }

  template <int dim>
  void ElementSweep<dim>::reinit(const typename DoFHandler<dim>::active_cell_iterator &next, const Vector &displacement)
  {
    cell = next;
    values.reinit(cell);
    cell->get_dof_indices(indices);
    for (unsigned int i = 0; i < indices.size(); ++i)
      u[i] = displacement[indices[i]];
    kernel.reinit(values, u);
    if (solid.options().share)
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        kernel.share(q, share_at(solid.options(), values.quadrature_point(q)));
  }

  template <int dim>
  void ElementSweep<dim>::integrate(const typename Solid<dim>::ElementPoints &points, const bool with_stiffness)
  {
    const double thickness = dim == 2 ? solid.options().thickness : 1.0;
    f.setZero();
    k.setZero();
    try
      {
        PointAnswer answer;
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
          {
            points.material->evaluate(points.first + q, kernel.strain(q), points.extent, with_stiffness, answer);
            kernel.add_force(answer.stress, f);
            if (with_stiffness)
              kernel.add_stiffness(answer.stress, answer.tangent, k);
          }
        if (!f.allFinite())
          throw MaterialFailure("the force of the element is not a number.");
      }
    catch (const MaterialFailure &problem)
      {
        throw in_element(cell, problem);
      }
    f *= thickness;
    k *= thickness;
  }

  template <int dim>
  void ElementSweep<dim>::add_to(const Sweep &wanted)
  {
    const auto n = static_cast<unsigned int>(indices.size());
    if (wanted.internal_force)
      for (unsigned int i = 0; i < n; ++i)
        (*wanted.internal_force)[indices[i]] += f[i];
    for (const auto &product : wanted.products)
      {
        for (unsigned int i = 0; i < n; ++i)
          g[i] = (*product.first)[indices[i]];
        const Eigen::VectorXd kg = k * g;
        for (unsigned int i = 0; i < n; ++i)
          (*product.second)[indices[i]] += kg[i];
      }
    if (wanted.tangent)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            local(i, j) = k(i, j);
        solid.constraints().distribute_local_to_global(local, indices, *wanted.tangent);
      }
  }

  template class ElementSweep<2>;
  template class ElementSweep<3>;
} // namespace fem
