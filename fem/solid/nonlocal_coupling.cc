#include "fem/solid/nonlocal_coupling.h"

#include "base/errors.h"
#include "fem/solid/element_sweep.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <set>

namespace fem
{
  using namespace dealii;

  template <int dim>
  bool NonlocalCoupling<dim>::wanted(const Solid<dim> &solid)
  {
    bool any = false;
    for (const auto &e : solid.element_points())
      any = any || dynamic_cast<AveragedPoints *>(e.material);
    return Utilities::MPI::max(any ? 1 : 0, solid.communicator()) == 1;
  }

  template <int dim>
  NonlocalCoupling<dim>::NonlocalCoupling(const Solid<dim> &solid_)
    : solid(solid_)
  {
    if (Utilities::MPI::n_mpi_processes(solid.communicator()) > 1)
      throw base::InputError("Nonlocal length: averages reach over ranks, which is not built. Use one process, or "
                             "leave the length out.");
    find_elements();
    find_neighbours();
  }

  template <int dim>
  void NonlocalCoupling<dim>::find_elements()
  {
    const FiniteElement<dim> &fe = solid.dofs().get_fe();
    FEValues<dim> values(solid.mapping(), fe, solid.quadrature(), update_quadrature_points | update_JxW_values);
    std::map<AveragedPoints *, std::pair<std::vector<Eigen::Vector3d>, std::vector<double>>> found;
    for (const auto &cell : solid.dofs().active_cell_iterators())
      {
        const auto &owner = solid.element_points()[elements.size()];
        Element     e{cell,
                  std::vector<types::global_dof_index>(fe.n_dofs_per_cell()),
                  dynamic_cast<AveragedPoints *>(owner.material),
                  owner.first,
                  {},
                  {},
                  {}};
        cell->get_dof_indices(e.dofs);
        elements.push_back(e);
        if (!e.points)
          continue;
        values.reinit(cell);
        auto &[places, volumes] = found[e.points];
        for (unsigned int q = 0; q < solid.quadrature().size(); ++q)
          {
            Eigen::Vector3d place = Eigen::Vector3d::Zero();
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = values.quadrature_point(q)[d];
            places.push_back(place);
            volumes.push_back(values.JxW(q));
            element_of[e.points].push_back(elements.size() - 1);
          }
      }
    for (auto &[points, where] : found)
      points->place(where.first, where.second);
  }

  template <int dim>
  void NonlocalCoupling<dim>::find_neighbours()
  {
    for (Element &e : elements)
      {
        std::set<std::size_t> near;
        for (unsigned int q = 0; e.points && q < solid.quadrature().size(); ++q)
          for (const auto &coupling : e.points->couplings(e.first + q))
            near.insert(element_of[e.points][coupling.first]);
        e.neighbours.assign(near.begin(), near.end());
      }
  }

  template <int dim>
  template <typename Visit>
  void NonlocalCoupling<dim>::visit_elements(const Vector &displacement, const Visit &visit)
  {
    const FiniteElement<dim> &fe = solid.dofs().get_fe();
    FEValues<dim>             values(solid.mapping(), fe, solid.quadrature(), update_gradients | update_JxW_values);
    ElementKernel<dim>        kernel(fe, solid.quadrature().size(), solid.options().large_displacement,
                                     solid.options().mean_dilatation);
    Eigen::VectorXd           u(fe.n_dofs_per_cell());
    for (Element &e : elements)
      {
        if (!e.points)
          continue;
        values.reinit(e.cell);
        for (unsigned int i = 0; i < e.dofs.size(); ++i)
          u[i] = displacement[e.dofs[i]];
        kernel.reinit(values, u);
        visit(e, kernel, values.get_JxW_values());
      }
  }

  template <int dim>
  void NonlocalCoupling<dim>::flow(const Vector &displacement, const bool with_tangent)
  {
    visit_elements(displacement, [&](Element &e, ElementKernel<dim> &kernel, const std::vector<double> &weights) {
      try
        {
          for (unsigned int q = 0; q < weights.size(); ++q)
            e.points->flow(e.first + q, kernel.strain(q), with_tangent);
        }
      catch (const MaterialFailure &problem)
        {
          throw in_element(e.cell, problem);
        }
    });
    for (const auto &entry : element_of)
      entry.first->average();
  }

  template <int dim>
  void NonlocalCoupling<dim>::add_to(TrilinosWrappers::SparsityPattern &pattern) const
  {
    for (const Element &e : elements)
      for (const std::size_t n : e.neighbours)
        for (const auto row : e.dofs)
          for (const auto column : elements[n].dofs)
            if (!solid.constraints().is_constrained(row) && !solid.constraints().is_constrained(column))
              pattern.add(row, column);
  }

  template <int dim>
  void NonlocalCoupling<dim>::add_tangent(const Vector &displacement, const Sweep &wanted)
  {
    const double thickness = dim == 2 ? solid.options().thickness : 1.0;
    visit_elements(displacement, [&](Element &e, ElementKernel<dim> &kernel, const std::vector<double> &weights) {
      const auto      n = static_cast<Eigen::Index>(e.dofs.size()), points = static_cast<Eigen::Index>(weights.size());
      Eigen::VectorXd force(n);
      e.force_by_average.resize(n, points);
      e.variable_by_displacement.resize(n, points);
      for (Eigen::Index q = 0; q < points; ++q)
        {
          const auto point = static_cast<unsigned int>(q);
          kernel.strain(point);
          force.setZero();
          kernel.add_force(e.points->response(e.first + point), force);
          e.force_by_average.col(q) = thickness * force;
          force.setZero();
          kernel.add_force(e.points->influence(e.first + point), force);
          e.variable_by_displacement.col(q) = force / weights[point];
        }
    });
    std::map<std::size_t, Eigen::MatrixXd> shares; // of the neighbours' variables in the averages of an element
    for (const Element &e : elements)
      {
        if (!e.points || e.force_by_average.isZero(0))
          continue;
        shares.clear();
        const Eigen::Index points = e.force_by_average.cols();
        for (Eigen::Index q = 0; q < points; ++q)
          for (const auto &[j, share] : e.points->couplings(e.first + static_cast<std::size_t>(q)))
            {
              const std::size_t other = element_of[e.points][j];
              Eigen::MatrixXd  &block = shares.try_emplace(other, Eigen::MatrixXd::Zero(points, points)).first->second;
              block(q, static_cast<Eigen::Index>(j - elements[other].first)) += share;
            }
        for (const auto &[other, share] : shares)
          if (const Element &o = elements[other]; !o.variable_by_displacement.isZero(0))
            add_block(e, o, e.force_by_average * share * o.variable_by_displacement.transpose(), wanted);
      }
  }

  template <int dim>
  void NonlocalCoupling<dim>::add_block(const Element         &rows,
                                        const Element         &columns,
                                        const Eigen::MatrixXd &block,
                                        const Sweep           &wanted) const
  {
    for (const auto &product : wanted.products)
      for (Eigen::Index i = 0; i < block.rows(); ++i)
        for (Eigen::Index j = 0; j < block.cols(); ++j)
          (*product.second)[rows.dofs[static_cast<std::size_t>(i)]] +=
            block(i, j) * (*product.first)[columns.dofs[static_cast<std::size_t>(j)]];
    if (!wanted.tangent)
      return;
    const auto                          &held = solid.constraints();
    std::vector<types::global_dof_index> free;
    std::vector<double>                  values;
    for (Eigen::Index i = 0; i < block.rows(); ++i)
      {
        const auto row = rows.dofs[static_cast<std::size_t>(i)];
        if (held.is_constrained(row))
          continue;
        free.clear();
        values.clear();
        for (Eigen::Index j = 0; j < block.cols(); ++j)
          if (const auto column = columns.dofs[static_cast<std::size_t>(j)]; !held.is_constrained(column))
            {
              free.push_back(column);
              values.push_back(block(i, j));
            }
        wanted.tangent->add(row, free.size(), free.data(), values.data());
      }
  }

  template class NonlocalCoupling<2>;
  template class NonlocalCoupling<3>;
}
