#include "apps/bench/plain_elasticity.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace apps
{
  using namespace dealii;

  namespace
  {
    constexpr double lambda = 30e9 * 0.2 / (1.2 * 0.6), mu = 30e9 / 2.4; // E = 30 GPa, nu = 0.2
  }

  PlainElasticity::PlainElasticity(const unsigned int divisions)
    : element(FE_Q<3>(1), 3)
    , dofs(mesh)
  {
    GridGenerator::subdivided_hyper_cube(mesh, divisions, 0, 1, true);
    dofs.distribute_dofs(element);
    DoFTools::make_zero_boundary_constraints(dofs, 0, held);
    held.close();
    DynamicSparsityPattern dynamic(dofs.n_dofs());
    DoFTools::make_sparsity_pattern(dofs, dynamic, held, false);
    pattern.copy_from(dynamic);
    matrix.reinit(pattern);
    for (auto *v : {&load, &x, &result, &velocity, &displacement, &force, &mass})
      v->reinit(dofs.n_dofs());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = std::sin(0.1 * i);
    mass = 2400.0 / dofs.n_dofs();
  }

  void PlainElasticity::assemble()
  {
    matrix = 0;
    load   = 0;
    const QGauss<3>                      points(2);
    FEValues<3>                          values(element, points, update_values | update_gradients | update_JxW_values);
    const unsigned int                   n = element.n_dofs_per_cell();
    FullMatrix<double>                   local(n, n);
    Vector<double>                       local_load(n);
    std::vector<types::global_dof_index> indices(n);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        local      = 0;
        local_load = 0;
        values.reinit(cell);
        for (const unsigned int i : values.dof_indices())
          {
            const unsigned int ci = element.system_to_component_index(i).first;
            for (const unsigned int j : values.dof_indices())
              {
                const unsigned int cj = element.system_to_component_index(j).first;
                for (const unsigned int q : values.quadrature_point_indices())
                  local(i, j) += (lambda * values.shape_grad(i, q)[ci] * values.shape_grad(j, q)[cj] +
                                  mu * values.shape_grad(i, q)[cj] * values.shape_grad(j, q)[ci] +
                                  (ci == cj ? mu * (values.shape_grad(i, q) * values.shape_grad(j, q)) : 0.0)) *
                                 values.JxW(q);
              }
            if (ci == 0)
              for (const unsigned int q : values.quadrature_point_indices())
                local_load[i] += 1e6 * values.shape_value(i, q) * values.JxW(q);
          }
        cell->get_dof_indices(indices);
        held.distribute_local_to_global(local, local_load, indices, matrix, load);
      }
  }

  void PlainElasticity::multiply() { matrix.vmult(result, x); }

  unsigned int PlainElasticity::solve()
  {
    SolverControl            control(5000, 1e-10 * load.l2_norm());
    SolverCG<Vector<double>> cg(control);
    PreconditionSSOR<>       smoother;
    smoother.initialize(matrix, 1.2);
    result = 0;
    cg.solve(matrix, result, load, smoother);
    return control.last_step();
  }

  void PlainElasticity::step(const double length)
  {
    force = 0;
    const QGauss<3>                      points(2);
    FEValues<3>                          values(element, points, update_gradients | update_JxW_values);
    const unsigned int                   n = element.n_dofs_per_cell();
    std::vector<types::global_dof_index> indices(n);
    Vector<double>                       u(n), f(n);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        cell->get_dof_values(displacement, u);
        f = 0;
        for (const unsigned int q : values.quadrature_point_indices())
          {
            Tensor<2, 3> gradient;
            for (unsigned int i = 0; i < n; ++i)
              gradient[element.system_to_component_index(i).first] += u[i] * values.shape_grad(i, q);
            const SymmetricTensor<2, 3> strain = symmetrize(gradient);
            const Tensor<2, 3>          stress =
              Tensor<2, 3>(lambda * trace(strain) * unit_symmetric_tensor<3>() + 2 * mu * strain);
            for (unsigned int i = 0; i < n; ++i)
              f[i] += stress[element.system_to_component_index(i).first] * values.shape_grad(i, q) * values.JxW(q);
          }
        cell->get_dof_indices(indices);
        force.add(indices, f);
      }
    for (unsigned int i = 0; i < force.size(); ++i)
      if (!held.is_constrained(i))
        {
          velocity[i] += length * (load[i] - force[i]) / mass[i];
          displacement[i] += length * velocity[i];
        }
  }
} // namespace apps
