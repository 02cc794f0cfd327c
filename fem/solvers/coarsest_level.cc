#include "fem/solvers/coarsest_level.h"

#include "fem/solid/element_kernel.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace fem
{
  using namespace dealii;

  template <int dim>
  CoarsestLevel<dim>::CoarsestLevel(const Solid<dim>                                         &solid_,
                                    const DoFHandler<dim>                                    &dofs_,
                                    const std::shared_ptr<const Utilities::MPI::Partitioner> &layout_,
                                    const AffineConstraints<double>                          &held_)
    : solid(solid_)
    , dofs(dofs_)
    , layout(layout_)
    , held(held_)
  {
    if (dofs.n_dofs(0) <= direct_limit)
      factorise();
    else
      set_up_multigrid();
  }

  template <int dim>
  template <typename Visit>
  void CoarsestLevel<dim>::visit_elements(const Visit &visit) const
  {
    const auto                          &fe = dofs.get_fe();
    const unsigned int                   n  = fe.n_dofs_per_cell();
    std::vector<types::global_dof_index> indices(n);
    FEValues<dim>      values(solid.mapping(), fe, solid.quadrature(), update_gradients | update_JxW_values);
    ElementKernel<dim> kernel(fe, solid.quadrature().size(), false, false);
    const double       thickness = dim == 2 ? solid.options().thickness : 1.0;
    for (const auto &cell : dofs.mg_cell_iterators_on_level(0))
      if (cell->is_locally_owned_on_level())
        {
          values.reinit(typename Triangulation<dim>::cell_iterator(cell));
          kernel.reinit(values, Eigen::VectorXd::Zero(n));
          Eigen::MatrixXd        k = Eigen::MatrixXd::Zero(n, n);
          const base::Stiffness &d = material_of(solid, cell).elastic_stiffness();
          for (unsigned int q = 0; q < solid.quadrature().size(); ++q)
            {
              kernel.strain(q);
              kernel.add_stiffness(base::Voigt::Zero(), d, k);
            }
          cell->get_mg_dof_indices(indices);
          visit(Eigen::MatrixXd(thickness * k), indices);
        }
  }

  template <int dim>
  void CoarsestLevel<dim>::factorise()
  {
    std::vector<std::tuple<unsigned int, unsigned int, double>> entries;
    visit_elements([&](const Eigen::MatrixXd &k, const std::vector<types::global_dof_index> &indices) {
      for (unsigned int i = 0; i < indices.size(); ++i)
        for (unsigned int j = 0; j < indices.size(); ++j)
          if (!held.is_constrained(indices[i]) && !held.is_constrained(indices[j]))
            entries.emplace_back(indices[i], indices[j], k(i, j));
          else if (i == j)
            entries.emplace_back(indices[i], indices[i], 1.0);
    });
    std::vector<Eigen::Triplet<double>> all;
    for (const auto &of_rank : Utilities::MPI::all_gather(solid.communicator(), entries))
      for (const auto &[i, j, value] : of_rank)
        all.emplace_back(i, j, value);
    Eigen::SparseMatrix<double> full(dofs.n_dofs(0), dofs.n_dofs(0));
    full.setFromTriplets(all.begin(), all.end());
    factors.compute(full);
    if (factors.info() != Eigen::Success)
      throw MaterialFailure("the stiffness of the coarsest mesh level is singular.");
  }

  template <int dim>
  void CoarsestLevel<dim>::set_up_multigrid()
  {
    const auto     &fe    = dofs.get_fe();
    const IndexSet &owned = dofs.locally_owned_mg_dofs(0);
    IndexSet        relevant;
    DoFTools::extract_locally_relevant_level_dofs(dofs, 0, relevant);
    TrilinosWrappers::SparsityPattern    pattern(owned, owned, relevant, solid.communicator());
    std::vector<std::vector<bool>>       modes(dim, std::vector<bool>(owned.n_elements(), false));
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : dofs.mg_cell_iterators_on_level(0))
      if (cell->is_locally_owned_on_level())
        {
          cell->get_mg_dof_indices(indices);
          held.add_entries_local_to_global(indices, pattern, true);
          for (unsigned int i = 0; i < indices.size(); ++i)
            if (owned.is_element(indices[i]))
              modes[fe.system_to_component_index(i).first][owned.index_within_set(indices[i])] = true;
        }
    pattern.compress();
    matrix.reinit(pattern);
    FullMatrix<double> local(indices.size(), indices.size());
    visit_elements([&](const Eigen::MatrixXd &k, const std::vector<types::global_dof_index> &numbers) {
      for (unsigned int i = 0; i < numbers.size(); ++i)
        for (unsigned int j = 0; j < numbers.size(); ++j)
          local(i, j) = k(i, j);
      held.distribute_local_to_global(local, numbers, matrix);
    });
    matrix.compress(VectorOperation::add);
    TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    settings.constant_modes        = modes;
    settings.elliptic              = true;
    settings.higher_order_elements = fe.degree > 1;
    settings.smoother_sweeps       = 2;
    settings.aggregation_threshold = 0.02;
    typename Smoother::AdditionalData steps;
    steps.degree              = numbers::invalid_unsigned_int; // as many as smoothing_range requires
    steps.smoothing_range     = 0.1;
    steps.eig_cg_n_iterations = 30;
    steps.preconditioner      = std::make_shared<TrilinosWrappers::PreconditionAMG>();
    steps.preconditioner->initialize(matrix, settings);
    cycles.initialize(matrix, steps);
    x.reinit(layout);
    b.reinit(layout);
  }

  template <int dim>
  void CoarsestLevel<dim>::solve(LevelVector &solution, const LevelVector &right_side) const
  {
    if (dofs.n_dofs(0) > direct_limit)
      {
        b.copy_locally_owned_data_from(right_side);
        cycles.vmult(x, b);
        solution.copy_locally_owned_data_from(x);
      }
    else
      {
        Eigen::VectorXd whole = Eigen::VectorXd::Zero(dofs.n_dofs(0));
        for (unsigned int i = 0; i < right_side.locally_owned_size(); ++i)
          whole[layout->local_to_global(i)] = right_side.local_element(i);
        Utilities::MPI::sum(ArrayView<const double>(whole.data(), whole.size()), solid.communicator(),
                            ArrayView<double>(whole.data(), whole.size()));
        const Eigen::VectorXd answer = factors.solve(whole);
        for (unsigned int i = 0; i < right_side.locally_owned_size(); ++i)
          solution.local_element(i) = static_cast<float>(answer[layout->local_to_global(i)]);
      }
    for (unsigned int i = 0; i < solution.locally_owned_size(); ++i)
      if (held.is_constrained(layout->local_to_global(i)))
        solution.local_element(i) = 0;
  }

  template <int dim>
  std::string CoarsestLevel<dim>::description() const
  {
    return "coarsest of " + std::to_string(dofs.n_dofs(0)) + " unknowns " +
           (dofs.n_dofs(0) <= direct_limit ? "factorised" : "by algebraic multigrid");
  }

  template class CoarsestLevel<2>;
  template class CoarsestLevel<3>;
}
